// Icons: one path each, on a square of 24.

const PATHS = {
  draw: "M4 20l1-5L15.5 4.5l4 4L9 19zM13 7l4 4",
  erase: "M9 20h11M4.5 14.5l9-9 6 6-8.5 8.5H8zM9 10l6 6",
  sensor: "M12 3l7 17-7-4-7 4z",
  pan: "M12 3v18M3 12h18M9.5 5.5L12 3l2.5 2.5M9.5 18.5L12 21l2.5-2.5M5.5 9.5L3 12l2.5 2.5M18.5 9.5L21 12l-2.5 2.5",
  path: "M5 19a2 2 0 1 0 .1 0M7 18c9-1 1-11 10-12M19 3a2 2 0 1 0 .1 0",
  look: "M2.500 12c4.500-7.500 14.500-7.500 19 0-4.500 7.500-14.500 7.500-19 0M12 9a3 3 0 1 0 .1 0",
  where: "M12 21c-4-5-6-7.500-6-11a6 6 0 0 1 12 0c0 3.500-2 6-6 11M12 8a2 2 0 1 0 .1 0",
  ghost: "M5 20V11a7 7 0 0 1 14 0v9l-2.300-2-2.400 2-2.300-2-2.300 2-2.400-2zM9.500 11v.5M14.500 11v.5",
  evidence: "M3 5l13 7M3 19l13-7M3 12h13M17 8.500h4.500v7H17z",
  undo: "M8 5L4 9l4 4M4 9h10a5.5 5.5 0 0 1 0 11h-4",
  redo: "M16 5l4 4-4 4M20 9H10a5.5 5.5 0 0 0 0 11h4",
  plus: "M12 5v14M5 12h14",
  minus: "M5 12h14",
  fit: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
  play: "M7 4.5l12 7.5-12 7.5z",
  pause: "M8.5 5v14M15.5 5v14",
  link: "M10 14a4 4 0 0 0 5.7 0l3-3A4 4 0 0 0 13 5.3l-1 1M14 10a4 4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",
  save: "M12 4v11M7.5 10.5L12 15l4.5-4.5M4 20h16",
  grid: "M4 4h16v16H4zM4 12h16M12 4v16",
  theme: "M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18",
  help: "M8.5 9a3.5 3.5 0 1 1 5 3.2c-1.1.6-1.5 1.200-1.500 2.500M12 18v.5",
  close: "M6 6l12 12M18 6L6 18",
};
export type IconName = keyof typeof PATHS;

export function icon(name: IconName): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  path.setAttribute("d", PATHS[name]);
  svg.append(path);
  return svg;
}
