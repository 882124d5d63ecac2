// Where sensors stand, and how one looks.

import { clamp, toCells } from "../geometry/cells";
import type { Grid, Point, Sensor } from "../protocol";
import type { Session } from "../state/session";
import { strokeOnHalo, type Scene } from "./layer";
import { write } from "./text";
import type { Viewport } from "./viewport";

/** The document's sensors, or of a file those of the scan on show. */
export function sensorsOf({ document, scan }: Session): Sensor[] {
  if (!document) return [];
  if (document.source.kind === "simulation" || !scan) return document.sensors;
  const ids = Array.from({ length: scan.pose.length / 3 }, (_, s) => s);
  return ids.map((s) => ({ id: s, x: scan.pose[3 * s], y: scan.pose[3 * s + 1], yaw: scan.pose[3 * s + 2] }));
}

/** A sensor on the canvas, its size, and the handle that turns it. */
export function placeOf(sensor: Sensor, grid: Grid, view: Viewport): { point: Point; size: number; handle: Point } {
  const point = view.fromGrid(toCells(sensor, grid), grid.shape[1]);
  const size = clamp(view.transform.scale * 0.42, 7, 13);
  const reach = size * 2.6;
  const handle = { x: point.x + reach * Math.cos(sensor.yaw), y: point.y - reach * Math.sin(sensor.yaw) };
  return { point, size, handle };
}

/** All sensors: arrows that point where they look, numbered where there are several. */
export function paintSensors(context: CanvasRenderingContext2D, { session, view, look }: Scene) {
  const document = session.document;
  if (!document) return;
  const { theme } = look;
  const sensors = sensorsOf(session);
  context.lineJoin = "round";
  for (const sensor of sensors) {
    const place = placeOf(sensor, document.grid, view);
    const { point, size } = place;
    if (sensor.id === look.selected) paintHandle(context, place, look);
    const [cos, sin] = [Math.cos(sensor.yaw), -Math.sin(sensor.yaw)];
    const to = (a: number, b: number) => [point.x + size * (a * cos - b * sin), point.y + size * (a * sin + b * cos)] as const;
    context.beginPath();
    context.moveTo(...to(1.25, 0));
    context.lineTo(...to(-0.9, 0.8));
    context.lineTo(...to(-0.45, 0));
    context.lineTo(...to(-0.9, -0.8));
    context.closePath();
    context.strokeStyle = theme.halo;
    context.lineWidth = 3;
    context.stroke();
    context.fillStyle = theme.sensor;
    context.fill();
    if (sensors.length > 1 && sensors.length < 100) {
      write(context, String(sensor.id), point.x, point.y + size * 2 + 4, theme, "center", true);
    }
  }
}

function paintHandle(context: CanvasRenderingContext2D, { point, size, handle }: ReturnType<typeof placeOf>, { theme }: Scene["look"]) {
  context.beginPath();
  context.moveTo(point.x, point.y);
  context.lineTo(handle.x, handle.y);
  context.moveTo(handle.x + 4.5, handle.y);
  context.arc(handle.x, handle.y, 4.5, 0, 2 * Math.PI);
  context.moveTo(point.x + size * 1.7, point.y);
  context.arc(point.x, point.y, size * 1.7, 0, 2 * Math.PI);
  strokeOnHalo(context, theme, theme.sensor, 1.5);
  context.beginPath();
  context.arc(handle.x, handle.y, 4, 0, 2 * Math.PI);
  context.fillStyle = theme.halo;
  context.fill();
}
