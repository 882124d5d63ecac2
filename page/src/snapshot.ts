// What the page offers to tests (docs/app.md).

import type { Stack } from "./layers/layer";
import type { Viewport } from "./layers/viewport";
import type { Beside } from "./state/beside";
import type { Session } from "./state/session";

/** What is known and shown. */
export function snapshot(session: Session, view: Viewport, stack: Stack, { kept }: Beside) {
  const { shown, status } = session;
  return {
    document: session.effectiveDocument(),
    generation: session.generation,
    painted: shown && {
      generation: shown.generation,
      layer: session.layer,
      approximate: shown.approximate,
      sweeps: shown.sweeps,
      method: shown.method,
      quantity: session.quantity,
      rhat: shown.rhat,
      verdict: shown.verdict,
      trace: shown.trace,
      traced: shown.traced,
      weights: shown.weights,
      ess: shown.ess,
      chain: shown.chain,
      draw: shown.draw,
    },
    probability: shown?.p ?? new Uint8Array(0),
    reached: shown?.reached ?? new Uint8Array(0),
    walls: session.walls,
    sensors: session.document?.sensors ?? [],
    scan: session.scan,
    status: { text: status.text, level: status.level },
    connected: session.connection.connected,
    decisions: { path: session.decisions.path, views: session.decisions.views, trouble: session.decisions.trouble || session.decisions.viewTrouble },
    where: { found: session.where.found, trouble: session.where.trouble },
    stage: session.stage,
    ghost: ghostOf(session),
    reading: { picked: session.reading.picked, found: session.reading.found, trouble: session.reading.trouble },
    evidence: { cell: session.evidence.cell, together: session.evidence.together, each: session.evidence.each && listsOf(session.evidence.each) },
    over: Boolean(session.flicker.under),
    beside: kept && { layer: kept.layer, chain: kept.view.chain, draw: kept.draw, method: kept.shown?.method, probability: Array.from(kept.shown?.p ?? []) },
    overlay: session.overlay && { strokes: session.overlay.strokes.length / 5, trajectory: session.overlay.trajectory.length / 2 },
    worker: session.worker,
    running: session.running,
    draws: session.draws,
    view: session.view,
    seq: { sent: session.acted, confirmed: session.state?.seq ?? 0 },
    events: { ...session.counts, eventToPaint_ms: session.latency.eventToPaint_ms },
    layers: { ...stack.paints },
    transform: { ...view.transform },
  };
}

const listsOf = (each: object) => Object.fromEntries(Object.entries(each).map(([name, value]) => [name, Array.from(value as Float64Array)]));

function ghostOf({ ghost }: Session) {
  const { held, pose, fan, answers, trouble } = ghost;
  return { held, pose, answers, trouble, fan: fan && { ...fan, near: fan.near && { ...fan.near } } };
}
