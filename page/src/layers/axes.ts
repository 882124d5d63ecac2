// Axes in metres, along the map's lower and left edge, or the canvas's where the map runs past it.

import type { Scene } from "./layer";
import { write } from "./text";
import { GUTTER } from "./viewport";

const PIXELS_A_TICK = 46;
/** From the left edge to the unit's right: half of a number that stands under the edge, and a gap. */
const UNIT_AWAY = 22;

/** 1, 2 or 5 times a power of ten, at least `least`. */
function niceStep(least: number) {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5].find((m) => m * power >= least) ?? 10);
}

export function paintAxes(context: CanvasRenderingContext2D, { session, view, look }: Scene) {
  if (!session.document) return;
  const { theme } = look;
  const { width, height } = view;
  const { origin, resolution, shape } = session.document.grid;
  const { scale, x, y } = view.transform;
  const step = niceStep((PIXELS_A_TICK / scale) * resolution);
  const bottom = Math.min(y + shape[1] * scale, height - GUTTER.bottom) + 0.5;
  const left = Math.max(x, GUTTER.left) - 0.5;
  // a strip for the numbers where the map runs under them
  context.fillStyle = theme.ground;
  if (x < left) context.fillRect(0, 0, left, height + 1);
  if (y + shape[1] * scale > bottom) context.fillRect(0, bottom, width + 1, height + 1 - bottom);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  context.strokeStyle = theme.frame;
  context.lineWidth = 1;
  context.beginPath();
  const first = (axis: 0 | 1) => Math.ceil(origin[axis] / step - 1e-9) * step;
  const last = (axis: 0 | 1) => origin[axis] + shape[axis] * resolution + 1e-9;
  for (let m = first(0); m <= last(0); m += step) {
    const at = x + ((m - origin[0]) / resolution) * scale;
    if (at < left || at > width - 4) continue;
    context.moveTo(at, bottom);
    context.lineTo(at, bottom + 4);
    write(context, m.toFixed(digits), at, bottom + 12, theme, "center");
  }
  for (let m = first(1); m <= last(1); m += step) {
    const at = y + (shape[1] - (m - origin[1]) / resolution) * scale;
    if (at > bottom || at < 4) continue;
    context.moveTo(left, at);
    context.lineTo(left - 4, at);
    write(context, m.toFixed(digits), left - 7, at, theme, "right");
  }
  context.stroke();
  write(context, "m", left - UNIT_AWAY, bottom + 12, theme, "right");
}
