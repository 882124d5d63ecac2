// The field: a colour for every cell, a hatch the denser the less probably a beam reaches it, the lines between large cells.

import { paletteOf, type Theme } from "../colour";
import type { Field, Layer as FieldName } from "../protocol";
import { clipToMap, type Layer, type Scene } from "./layer";

const LINES_FROM_SCALE = 10;
const HATCH_PIXELS = 7;

type Kind = "value" | "entropy" | "width" | "state";
/** What the colours of a field mean: the entropy is made of the mean here, and a draw of walls has two states. */
const kindOf = ({ layer, quantity }: Field, wanted: FieldName): Kind =>
  layer === "draw" && quantity.kind === "binary" ? "state" : layer === "width" ? "width" : wanted === "entropy" && layer !== "draw" ? "entropy" : "value";

const sheet = () => document.createElement("canvas").getContext("2d") as CanvasRenderingContext2D;

/** A pixel a cell, blown up in one blit, whatever the number of cells. */
export class FieldLayer implements Layer {
  readonly name = "field";
  private readonly cells = sheet();
  /** As opaque as it is improbable that a beam reaches the cell. */
  private readonly mask = sheet();
  /** The mask at the canvas's size, filled with oblique lines. */
  private readonly hatch = sheet();
  private readonly palettes = new Map<string, Uint32Array>();
  private image = new ImageData(1, 1);
  private drawn = { field: null as Field | null, reached: null as Uint8Array | null, palette: "", hatch: "" };

  depends({ session }: Scene) {
    return [session.picture, session.layer === "entropy", ...session.shape];
  }

  shows({ session }: Scene) {
    return session.document !== null;
  }

  paint(context: CanvasRenderingContext2D, scene: Scene) {
    const { session, view, look } = scene;
    if (!session.document) return;
    const [nx, ny] = session.shape;
    const { scale, x, y } = view.transform;
    clipToMap(context, scene);
    const field = session.picture;
    if (!field || field.p.length !== nx * ny) {
      context.fillStyle = look.theme.unobserved;
      context.fillRect(x, y, nx * scale, ny * scale);
      return;
    }
    this.fill(field, nx, ny, look.theme, kindOf(field, session.layer));
    context.imageSmoothingEnabled = false;
    context.drawImage(this.cells.canvas, x, y, nx * scale, ny * scale);
    this.fillHatch(scene);
    context.drawImage(this.hatch.canvas, 0, 0, this.hatch.canvas.width / view.ratio, this.hatch.canvas.height / view.ratio);
    if (scale >= LINES_FROM_SCALE) this.lines(context, scene);
  }

  /** Colours the cells, and the mask where the observed cells are others. */
  private fill(field: Field, nx: number, ny: number, theme: Theme, kind: Kind) {
    const { cells, mask, drawn } = this;
    const name = `${theme.ground} ${kind}`;
    if (drawn.field === field && drawn.palette === name) return;
    const palette = this.palettes.get(name) ?? paletteOf(theme, kind);
    this.palettes.set(name, palette);
    if (this.image.width !== nx || this.image.height !== ny) {
      this.image = new ImageData(nx, ny);
      for (const { canvas } of [cells, mask]) Object.assign(canvas, { width: nx, height: ny });
      drawn.reached = null;
    }
    const pixels = new Uint32Array(this.image.data.buffer);
    for (let row = 0, k = 0; row < ny; row++) {
      for (let i = ny - 1 - row; i < nx * ny; i += ny) pixels[k++] = palette[field.p[i] + 256 * ((field.reached[i] + 8) >> 4)];
    }
    cells.putImageData(this.image, 0, 0);
    if (drawn.reached !== field.reached) {
      for (let row = 0, k = 0; row < ny; row++) {
        for (let i = ny - 1 - row; i < nx * ny; i += ny) pixels[k++] = (255 - field.reached[i]) << 24;
      }
      mask.putImageData(this.image, 0, 0);
      drawn.hatch = "";
    }
    Object.assign(drawn, { field, reached: field.reached, palette: name });
  }

  /** Oblique lines where beams may not reach, at the same distance on screen at any zoom. */
  private fillHatch({ session, view, look }: Scene) {
    const { hatch, mask, drawn } = this;
    const { ratio, width, height } = view;
    const { scale, x, y } = view.transform;
    const [nx, ny] = session.shape;
    const key = [look.theme.ground, scale, x, y, width, height, ratio].join(" ");
    if (drawn.hatch === key) return;
    drawn.hatch = key;
    const tile = sheet();
    const size = (tile.canvas.width = tile.canvas.height = Math.round(HATCH_PIXELS * ratio));
    tile.strokeStyle = look.theme.hatch;
    tile.lineWidth = ratio;
    tile.beginPath();
    for (const shift of [-size, 0, size]) {
      tile.moveTo(shift - 1, size + 1);
      tile.lineTo(shift + size + 1, -1);
    }
    tile.stroke();
    Object.assign(hatch.canvas, { width: Math.ceil(width * ratio), height: Math.ceil(height * ratio) });
    hatch.setTransform(ratio, 0, 0, ratio, 0, 0);
    hatch.imageSmoothingEnabled = false;
    hatch.drawImage(mask.canvas, x, y, nx * scale, ny * scale);
    hatch.globalCompositeOperation = "source-in";
    hatch.setTransform(1, 0, 0, 1, 0, 0);
    const pattern = hatch.createPattern(tile.canvas, "repeat") as CanvasPattern;
    pattern.setTransform(new DOMMatrix().translate(Math.round(x * ratio), Math.round(y * ratio)));
    hatch.fillStyle = pattern;
    hatch.fillRect(0, 0, hatch.canvas.width, hatch.canvas.height);
  }

  private lines(context: CanvasRenderingContext2D, { session, view, look }: Scene) {
    const [nx, ny] = session.shape;
    const { scale, x, y } = view.transform;
    context.beginPath();
    for (let i = 1; i < nx; i++) {
      context.moveTo(x + i * scale, y);
      context.lineTo(x + i * scale, y + ny * scale);
    }
    for (let j = 1; j < ny; j++) {
      context.moveTo(x, y + j * scale);
      context.lineTo(x + nx * scale, y + j * scale);
    }
    context.strokeStyle = look.theme.lines;
    context.lineWidth = 1;
    context.stroke();
  }
}
