"""A hand on the page: JavaScript that moves a pointer over the map, or a slider, at a steady rate."""

EVENTS_PER_SECOND = 30.0

HAND = """
const root = document.querySelector("[data-bayesmap]").shadowRoot;
/** Calls `move` so many times a second and `look` in every frame: how often it moved, and for how many seconds. */
const steadily = (seconds, rate, move, look) => new Promise((done) => {
  const start = performance.now();
  let sent = 0, stop = false;
  const watch = () => {
    look();
    if (!stop) requestAnimationFrame(watch);
  };
  watch();
  const timer = setInterval(() => {
    const t = (performance.now() - start) / 1000;
    if (t <= seconds) return move(t, sent++);
    clearInterval(timer);
    stop = true;
    done({ sent, seconds: t });
  }, 1000 / rate);
});
/** A mouse on the map at a place of the page. */
const point = (type, { x, y }) => {
  const canvas = root.querySelector("canvas[role=application]");
  canvas.setPointerCapture = () => {};
  canvas.dispatchEvent(new PointerEvent(type,
    { clientX: x, clientY: y, pointerId: 1, bubbles: true, pointerType: "mouse" }));
};
/** Where a point of the world is on the page. */
const placeOf = ([x, y]) => {
  const { resolution, origin } = bayesmap.snapshot().document.grid;
  return bayesmap.cellToClient((x - origin[0]) / resolution - 0.5, (y - origin[1]) / resolution - 0.5);
};
"""


def by_hand(body: str) -> str:
    """An asynchronous function of one argument, `given`, whose body may use the hand."""
    return f"async (given) => {{ {HAND} {body} }}"
