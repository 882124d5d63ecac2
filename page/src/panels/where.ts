// "Where am I?" in words: how many places, how probable each is, how well it is known, or that the scan fits nowhere.

import { percent } from "../layers/where";
import type { Place, Whereabouts } from "../messages";
import { h, put } from "./dom";
import type { Ui } from "./ui";

/** A robot that may be anywhere within so much is nowhere in particular. */
const ANYWHERE_M = 2;
const LISTED = 6;
const TIED = 0.9; // share of the greatest probability from which a place is as probable as the first
const LOST = 0.5;
const MENTIONED = 0.005;

export function wherePanel(ui: Ui) {
  const { session, hand } = ui;
  const said = h("p", { className: "whereabouts", role: "status" });
  const hint = h("p", { className: "caption" });
  const section = ui.section("Where am I?", said, hint);
  ui.visible(section, () => hand.tool === "where");
  ui.each(() => {
    session.where.follow(hand.tool === "where", hand.sensor?.id ?? null);
    put(said, "textContent", words(ui));
    const drawn = "Drag the robot: its scan is located among the walls that are drawn, which the map shows, as if nothing were known of its pose.";
    const recorded = "Choose a scan below: it is located in this map, as if nothing were known of its pose. The arrow is where it was recorded.";
    put(hint, "textContent", session.editable ? drawn : recorded);
  });
  return section;
}

function words({ session }: Ui) {
  const { found, trouble } = session.where;
  if (trouble) return `${trouble.charAt(0).toUpperCase()}${trouble.slice(1)}.`;
  if (!found) return "Looking everywhere.";
  const lost =
    found.p_lost > LOST
      ? `The scan fits nowhere on this map, with probability ${found.p_lost.toFixed(2)}: the robot is lost, or the map is outdated. If it is on the map: `
      : "";
  const doubt = !lost && found.p_lost > MENTIONED ? ` That it is lost, or the map outdated, has probability ${found.p_lost.toFixed(2)}.` : "";
  return `${lost}${places(found.modes)}${session.where.current ? truth(found, session.editable) : " Looking again."}${doubt}`;
}

function places(modes: Place[]) {
  const [first, second] = modes;
  if (!first) return "No place.";
  const vague = first.sigma_m > ANYWHERE_M;
  const at = `${first.mean[0].toFixed(2)}, ${first.mean[1].toFixed(2)} m, heading ${degrees(first.mean[2], 0)}`;
  const known = `known to ${length(first.sigma_m)} and ${degrees(first.sigma_rad, 1)}`;
  if (!second) return vague ? `It may be almost anywhere: positions are ${length(first.sigma_m)} apart.` : `One place: ${at}, ${known}.`;
  const listed = modes.slice(0, LISTED).map(({ probability }) => percent(probability));
  const tied = second.probability > TIED * first.probability;
  const more = modes.length > LISTED ? " and less" : "";
  return `${modes.length} places: ${listed.join(", ")}${more}. ${tied ? "One of them" : "The likeliest"}: ${at}, ${known}.`;
}

/** How far the truth, or what the file says, is from the nearest place. */
function truth({ modes, pose }: Whereabouts, drawn: boolean) {
  if (!modes.length || modes[0].sigma_m > ANYWHERE_M) return "";
  const away = modes.map(({ mean }) => Math.hypot(mean[0] - pose[0], mean[1] - pose[1]));
  const nearest = away.indexOf(Math.min(...away));
  const turn = Math.abs(Math.atan2(Math.sin(modes[nearest].mean[2] - pose[2]), Math.cos(modes[nearest].mean[2] - pose[2])));
  const which = modes.length === 1 ? "there" : nearest === 0 ? "the likeliest" : `the ${ordinal(nearest + 1)}`;
  return ` The robot ${drawn ? "stands" : "was recorded"} ${length(away[nearest])} and ${degrees(turn, 1)} from ${which}.`;
}

const ordinal = (n: number) => `${n}${["th", "st", "nd", "rd"][n % 100 > 10 && n % 100 < 14 ? 0 : n % 10] ?? "th"}`;
const degrees = (rad: number, digits: number) => `${((rad * 180) / Math.PI).toFixed(digits).replace(/^-(?=0(\.0*)?$)/, "")}\u00b0`;
const length = (m: number) => (m < 0.0095 ? `${(1000 * m).toFixed(0)} mm` : m < 1 ? `${(100 * m).toFixed(0)} cm` : `${m.toFixed(1)} m`);
