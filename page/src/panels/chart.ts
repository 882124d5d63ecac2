// Charts by uPlot: the traces of all chains, and the weights of particles.

import uPlot from "uplot";
import type { Theme } from "../colour";
import { FONT } from "../layers/text";
import type { Field } from "../protocol";
import { h, put } from "./dom";
import type { Ui } from "./ui";

const HEIGHT = 128;
const FIRST_SWEEPS = 50;
/** The scale of a trace is that of its later part: chains come from far away. */
const SETTLED_FROM = 0.25;

type Range = "all" | "first";

const chainColors = (theme: Theme) => [theme.ray, theme.truth, theme.sensor, theme.noReturn];
/** As wide as its longest number: log joints of buildings have seven figures. */
const asWideAsNumbers = (_: uPlot, values: string[] | null) => Math.max(40, 14 + 6.6 * Math.max(0, ...(values ?? []).map((value) => value?.length ?? 0)));
/** Room for the right half of the last number: it stands under the end of the line. */
const halfOfLast = ({ data }: uPlot) => Math.max(10, 4 + 3.3 * (data?.[0]?.at(-1) ?? 0).toLocaleString("en").length);
const axis = (theme: () => Theme, size: uPlot.Axis.Size): uPlot.Axis => ({
  font: FONT,
  size,
  stroke: () => theme().axis,
  grid: { stroke: () => theme().lines, width: 1 },
  ticks: { stroke: () => theme().frame, width: 1, size: 4 },
});

/** Keeps a chart as wide as its place and in the theme's colours. */
function kept(place: HTMLElement, make: () => uPlot, theme: () => Theme) {
  let chart: uPlot | null = null;
  let dressed: Theme | null = null;
  const width = () => Math.floor(place.clientWidth);
  new ResizeObserver(() => chart && width() > 0 && chart.setSize({ width: width(), height: HEIGHT })).observe(place);
  return (again: boolean) => {
    if (width() <= 0) return null;
    if (!chart || again || dressed !== theme()) {
      chart?.destroy();
      chart = make();
      chart.setSize({ width: width(), height: HEIGHT });
      dressed = theme();
    }
    return chart;
  };
}

/** Log joint by sweep, a line a chain; a bar marks the draw on show. */
export function traceChart(ui: Ui, theme: () => Theme) {
  const { session } = ui;
  const place = h("div", { className: "chart", role: "img", "aria-label": "Trace: log joint by sweep" });
  let range: Range = "all";
  const choice = ui.segmented<Range>(
    "Trace",
    [
      ["all", "All"],
      ["first", `First ${FIRST_SWEEPS}`],
    ],
    () => range,
    (value) => {
      range = value;
      drawn = null;
      session.changed();
    },
  );
  let chains = 0;
  let settled = -Infinity;
  let marked = -1;
  let drawn: Field | null = null;
  const make = () => {
    const colors = chainColors(theme());
    const series = Array.from({ length: chains }, (_, c) => ({ label: `chain ${c + 1}`, stroke: colors[c % colors.length], width: 1, points: { show: false } }));
    return new uPlot(
      {
        width: 100,
        height: HEIGHT,
        legend: { show: false },
        cursor: { drag: { x: false, y: false }, y: false },
        padding: [8, halfOfLast, 0, 0],
        scales: { x: { time: false, range: (_, low, high) => [low, Math.max(high, low + 1)] }, y: { range: (_, low, high) => padded(Math.max(low, settled), high) } },
        axes: [axis(theme, 26), axis(theme, asWideAsNumbers)],
        series: [{ label: "sweep" }, ...series],
        hooks: { draw: [(chart) => mark(chart, marked, theme()), (chart) => shade(chart, drawn?.burned ?? 0, theme())] },
      },
      [[], ...series.map(() => [])],
      place,
    );
  };
  const chartOf = kept(place, make, theme);
  const caption = h("span", { className: "caption", textContent: "log joint by sweep" });
  const element = h("div", { className: "charted" }, h("div", { className: "buttons" }, choice, caption), place);
  ui.each(() => {
    const field = session.shown;
    const count = field?.traced?.length ? field.trace.length / field.traced.length : 0;
    put(element, "hidden", count === 0 && (element.hidden || !session.working)); // a trace stays until the next begins
    if (!field || !count) return;
    const of = session.document?.source.kind === "run" ? "draw" : "sweep"; // a saved run has no more
    put(caption, "textContent", `log joint by ${of}`);
    const sweep = field.layer === "draw" && session.draws.count ? ((session.draw + 1) * field.traced[field.traced.length - 1]) / session.draws.count : -1;
    const chart = chartOf(count !== chains && ((chains = count), true));
    if (!chart) return;
    if (drawn === field && marked === sweep && chart.data[0].length) return;
    [drawn, marked] = [field, sweep];
    settled = range === "all" ? lowestSettled(field, count) : -Infinity;
    const part = shownPart(field, count, range);
    chart.setData(part as uPlot.AlignedData);
    place.setAttribute("data-sweeps", part[0].join());
  });
  return element;
}

/** [sweeps, log joint of each chain] of the first sweeps, or of evenly many over all. */
export function shownPart({ trace, traced }: Field, chains: number, range: Range) {
  const some = range === "all" ? evenSweeps(traced) : [...traced.keys()].filter((i) => traced[i] <= FIRST_SWEEPS);
  const at = (values: Float32Array) => Float32Array.from(some, (i) => values[i]);
  return [at(traced), ...Array.from({ length: chains }, (_, c) => at(trace.subarray(c * traced.length, (c + 1) * traced.length)))];
}

/** Where sweeps stand that are evenly far apart: the first ones are all there, and would look more restless than the rest. */
export function evenSweeps(traced: Float32Array) {
  const n = traced.length;
  const step = n > 2 ? Math.min(traced[n - 1] - traced[n - 2], traced[n - 2] - traced[n - 3]) : 1;
  let next = -Infinity;
  return [...traced.keys()].filter((i) => {
    if (traced[i] < next && i < n - 1) return false;
    next = traced[i] + step;
    return true;
  });
}

/** The lowest log joint of any chain in the later part. */
export function lowestSettled({ trace, traced }: Field, chains: number) {
  const n = traced.length;
  const from = traced.findIndex((sweep) => sweep >= SETTLED_FROM * traced[n - 1]);
  return Math.min(...Array.from({ length: chains }, (_, c) => Math.min(...trace.slice(c * n + from, (c + 1) * n))));
}

function padded(low: number, high: number): [number, number] {
  const pad = Math.max(0.06 * (high - low), 0.5);
  return [low - pad, high + pad];
}

/** A veil over the sweeps that are left out. */
function shade(chart: uPlot, burned: number, theme: Theme) {
  const { left, top, width, height } = chart.bbox;
  if (!burned) return;
  chart.ctx.save();
  chart.ctx.globalAlpha = 0.12;
  chart.ctx.fillStyle = theme.axis;
  chart.ctx.fillRect(left, top, Math.min(width, Math.max(0, chart.valToPos(burned, "x", true) - left)), height);
  chart.ctx.restore();
}

/** A vertical bar at a sweep. */
function mark(chart: uPlot, sweep: number, theme: Theme) {
  if (sweep < 0) return;
  const { left, top, width, height } = chart.bbox;
  const x = chart.valToPos(sweep, "x", true);
  if (x < left || x > left + width) return;
  chart.ctx.save();
  chart.ctx.fillStyle = theme.axis;
  chart.ctx.fillRect(x - 1, top, 2, height);
  chart.ctx.restore();
}

/** How many particles weigh how much, in nats below the heaviest; both ways logarithmic. */
export function weightChart(ui: Ui, theme: () => Theme) {
  const { session } = ui;
  const place = h("div", { className: "chart", role: "img", "aria-label": "Histogram of the particles' weights" });
  const caption = h("div", { className: "caption", textContent: "particles by weight, nats below the heaviest" });
  const element = h("div", { className: "charted" }, caption, place);
  const make = () =>
    new uPlot(
      {
        width: 100,
        height: HEIGHT,
        legend: { show: false },
        cursor: { show: false },
        padding: [8, 10, 0, 0],
        scales: { x: { time: false, range: (_, low, high) => [low, high] }, y: { distr: 3, range: (_, _low, high) => [0.5, Math.max(10, 2 * high)] } },
        axes: [axis(theme, 26), { ...axis(theme, 52), values: (_, ticks) => ticks.map((tick) => (tick >= 1 ? String(tick) : "")) }],
        series: [{}, { fill: theme().ray, stroke: theme().ray, paths: uPlot.paths.bars?.({ size: [0.9, 100], align: 1 }), points: { show: false } }],
      },
      [[], []],
      place,
    );
  const chartOf = kept(place, make, theme);
  let drawn: Field | null = null;
  ui.each(() => {
    const field = session.shown;
    put(element, "hidden", !field?.weights);
    const chart = field?.weights && chartOf(false);
    if (!field?.weights || !chart || (drawn === field && chart.data[0].length)) return;
    drawn = field;
    const counts = [...field.weights];
    const step = -(field.lowest ?? -1) / counts.length;
    const x = [...counts.map((_, i) => (field.lowest ?? -1) + i * step), 0];
    chart.setData([x, [...counts.map((count) => count || null), null]]);
  });
  return element;
}
