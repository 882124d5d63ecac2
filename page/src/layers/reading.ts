// The reading under the pointer: its beam, its predicted median and interval.

import { clamp, toCells } from "../geometry/cells";
import { clipToMap, type Layer, type Scene } from "./layer";

export class ReadingLayer implements Layer {
  readonly name = "reading";

  depends({ session }: Scene) {
    return [session.reading.version, session.document?.grid.resolution];
  }

  shows({ session: { reading, document, scan, ghost } }: Scene) {
    return Boolean(!ghost.held && reading.picked && document && scan?.index === reading.picked.scan);
  }

  paint(context: CanvasRenderingContext2D, scene: Scene) {
    const { session, view, look } = scene;
    const { picked, found } = session.reading;
    const { scan, document } = session;
    if (!picked || !document || scan?.index !== picked.scan) return;
    clipToMap(context, scene);
    const { grid, max_range } = document;
    const at = (range: number) => {
      const world = { x: picked.from.x + range * Math.cos(picked.angle), y: picked.from.y + range * Math.sin(picked.angle) };
      return view.fromGrid(toCells(world, grid), grid.shape[1]);
    };
    const line = (from: { x: number; y: number }, to: { x: number; y: number }, width: number, colour: string) => {
      context.beginPath();
      context.moveTo(from.x, from.y);
      context.lineTo(to.x, to.y);
      context.lineWidth = width;
      context.strokeStyle = colour;
      context.stroke();
    };
    const hit = scan.hit[picked.beam] === 1;
    const end = at(hit ? scan.ranges[picked.beam] : max_range);
    line(at(0), end, 3, look.theme.halo);
    line(at(0), end, 1.5, hit ? look.theme.ray : look.theme.noReturn);
    context.lineCap = "butt";
    if (found) {
      const range = (value: number | null, otherwise: number) => clamp(value ?? otherwise, 0, max_range);
      line(at(range(found.low, 0)), at(range(found.high, max_range)), 6, look.theme.ghost);
      if (found.median !== null) {
        const place = at(found.median);
        const across = { x: 7 * Math.sin(picked.angle), y: 7 * Math.cos(picked.angle) };
        line({ x: place.x - across.x, y: place.y - across.y }, { x: place.x + across.x, y: place.y + across.y }, 2.5, look.theme.ghost);
      }
    }
    if (!hit) return;
    context.beginPath();
    context.arc(end.x, end.y, 4.5, 0, 2 * Math.PI);
    context.fillStyle = look.theme.ray;
    context.fill();
    context.lineWidth = 2;
    context.strokeStyle = look.theme.halo;
    context.stroke();
  }
}
