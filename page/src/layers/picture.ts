// The whole map as a file, at twice the pixels, as it looks now.

import { clamp } from "../geometry/cells";
import { DecisionsLayer } from "./decisions";
import { FieldLayer } from "./field";
import { GhostLayer } from "./ghost";
import { HypothesisLayer } from "./hypothesis";
import type { Layer, Scene } from "./layer";
import { MarksLayer } from "./marks";
import { OverlayLayer } from "./overlay";
import { RaysLayer } from "./rays";
import { Viewport } from "./viewport";
import { WhereLayer } from "./where";

const WIDTH = 900;
const RATIO = 2;

/** What a map shows that no pointer is on. */
export const stillLayers = (): Layer[] => [
  new FieldLayer(), new HypothesisLayer(), new OverlayLayer(), new RaysLayer(), new MarksLayer(), new DecisionsLayer(), new WhereLayer(), new GhostLayer(),
];

/** A PNG of the map with its marks, without cursors. */
export function picture({ session, look }: Scene): Promise<Blob | null> {
  const [nx, ny] = session.shape;
  const view = new Viewport();
  view.resize(WIDTH, Math.round(clamp((WIDTH * ny) / nx, 300, 1800)), RATIO);
  view.fit(session.shape);
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width: view.width * RATIO, height: view.height * RATIO });
  const context = canvas.getContext("2d") as CanvasRenderingContext2D;
  context.scale(RATIO, RATIO);
  context.fillStyle = look.theme.ground;
  context.fillRect(0, 0, view.width, view.height);
  const still: Scene = { session, view, look: { ...look, hover: null, cursor: null, selected: null } };
  for (const layer of stillLayers()) {
    if (!(layer.shows?.(still) ?? true)) continue;
    context.save();
    layer.paint(context, still);
    context.restore();
  }
  return new Promise((done) => canvas.toBlob(done));
}
