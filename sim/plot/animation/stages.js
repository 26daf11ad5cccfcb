// Drawings of the mechanisms: each function draws one into an SVG and returns a function to move it.
//
//     draw(svg, stage, motions, width) -> { height, move(states) }
//
// `motions` and `states` have the same order; a state is {position, velocity, heading} at the cursor.

import { roundTicks, short } from "./ticks.js";

const NAMESPACE = "http://www.w3.org/2000/svg";
const TURN = 180 / Math.PI; // [deg/rad]

/** A new SVG element inside another one. */
export function draw(parent, name, attributes = {}, text = "") {
  const element = document.createElementNS(NAMESPACE, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text) element.textContent = text;
  parent.append(element);
  return element;
}

const bounded = (value, low, high) => Math.min(Math.max(value, low), high);
const place = (element, x, y, angle = 0) =>
  element.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)}) rotate(${angle.toFixed(2)})`);

/** SVG attributes of a filled shape, or of a dashed outline. */
function paint(motion) {
  return motion.ghost
    ? { fill: "none", stroke: motion.color, "stroke-width": 1.8, "stroke-dasharray": "4 3" }
    : { fill: motion.color, stroke: "currentColor", "stroke-width": 1.2 };
}

/** Draw the bodies of each solid motion, behind it those of all outlines, and name the motions.
 *
 * @param namePlace where the name of a motion stands: attributes of a text; null writes none.
 * @param drawBody draws one body; returns a function that moves it to a state.
 * @returns a function that moves all bodies.
 */
function drawBodies(svg, motions, namePlace, drawBody) {
  const all = motions.map((motion, at) => ({ ...motion, at }));
  const [ghosts, solids] = [true, false].map((kind) => all.filter(({ ghost }) => Boolean(ghost) === kind));
  const moves = solids.flatMap((solid, slot) => {
    if (namePlace && solids.length > 1) draw(svg, "text", namePlace(slot, solids.length), solid.name);
    return [...ghosts, solid].map((motion) => ({ at: motion.at, move: drawBody(motion, slot, solids.length) }));
  });
  return (states) => { for (const { at, move } of moves) move(states[at]); };
}

const countSolid = (motions) => motions.filter(({ ghost }) => !ghost).length;

/** A floor with a lane for each robot, seen from the side. */
function drawFloor(svg, stage, motions, width, lane) {
  const [left, right] = [14, width - 14];
  const scale = (right - left) / (stage.high - stage.low);
  const toX = (value) => left + (bounded(value, stage.low, stage.high) - stage.low) * scale;
  const lanes = countSolid(motions);
  const bottom = lane * lanes - 4;
  const standing = (x, more) => draw(svg, "line", { x1: x, x2: x, y1: 2, y2: bottom, stroke: "currentColor", ...more });
  const label = (x, text) => draw(svg, "text", { x, y: 13, "text-anchor": "end" }, text);
  for (let row = 1; row <= lanes; row++) {
    draw(svg, "line", { x1: left, x2: right, y1: lane * row - 4, y2: lane * row - 4, stroke: "currentColor" });
  }
  for (const value of roundTicks(stage.low, stage.high, (right - left) / 60)) {
    standing(toX(value), { y1: bottom, y2: bottom + 5 });
    draw(svg, "text", { x: toX(value), y: bottom + 17, "text-anchor": "middle" }, `${short(value)}${value === 0 ? " m" : ""}`);
  }
  for (const mark of stage.marks) {
    standing(toX(mark.at), { "stroke-dasharray": "2 3" });
    label(toX(mark.at) - 4, mark.label);
  }
  if (stage.wall !== null) {
    const x = toX(stage.wall);
    const block = { x, y: 2, height: bottom - 2, fill: "currentColor" };
    draw(svg, "rect", { ...block, width: Math.max(width - x, 0), opacity: 0.15 });
    draw(svg, "rect", { ...block, width: 7 });
    label(x - 5, "wall");
  }
  return { toX, scale, height: lane * lanes + 20, namePlace: (row) => ({ x: left, y: lane * row + 10 }) };
}

function drawDrivetrain(svg, stage, motions, width) {
  const lane = 58;
  const { toX, scale, height, namePlace } = drawFloor(svg, stage, motions, width, lane);
  const long = bounded(0.8 * scale, 30, 56); // [px] a robot is 0.8 m long, but always visible
  const tall = bounded(long * 0.32, 10, 16);
  const wheel = bounded(long * 0.16, 5, 8);
  const [top, middle] = [-tall - wheel * 1.2 - 7, -long / 2];
  let hit = null; // the lane of a robot that touches the wall
  const move = drawBodies(svg, motions, namePlace, (motion, row) => {
    const car = draw(svg, "g");
    const look = paint(motion);
    draw(car, "rect", { x: -long, y: -tall - wheel * 1.2, width: long, height: tall, rx: 3, ...look });
    const wheels = [-long + wheel * 1.4, -wheel * 1.4].map((x) => {
      const turning = draw(car, "g");
      draw(turning, "circle", { r: wheel, ...look, fill: motion.ghost ? "none" : "var(--motion-ground)" });
      if (!motion.ghost) draw(turning, "path", { d: `M${-wheel} 0H${wheel}M0 ${-wheel}V${wheel}`, stroke: "currentColor" });
      return (angle) => place(turning, x, -wheel, angle);
    });
    const arrow = draw(car, "path", { fill: "none", stroke: motion.color, "stroke-width": 2.5 });
    return ({ position, velocity }) => {
      place(car, toX(position), lane * (row + 1) - 4);
      for (const turn of wheels) turn((position * scale * TURN) / wheel);
      const reach = bounded(velocity * 14, -44, 44);
      const tip = bounded(reach, -5, 5);
      arrow.setAttribute("d", Math.abs(reach) < 1 ? "" : `M${middle} ${top}h${reach}m${-tip} -4l${tip} 4l${-tip} 4`);
      if (!motion.ghost && stage.wall !== null && position >= stage.wall - 1e-3) hit ??= row;
    };
  });
  const star = draw(svg, "text", { "font-size": 26, class: "motion-hit" }, "✸");
  return {
    height,
    move(states) {
      hit = null;
      move(states);
      star.setAttribute("visibility", hit === null ? "hidden" : "visible");
      if (hit !== null) place(star, toX(stage.wall) - 14, lane * (hit + 1) - 14);
    },
  };
}

function drawElevator(svg, stage, motions, width) {
  const [top, bottom] = [24, 232];
  const scale = (bottom - top - 26) / (stage.high - stage.low);
  const wide = Math.min(56, width / countSolid(motions) - 26);
  const middleOf = (column, columns) => (width * (column + 0.5)) / columns;
  const namePlace = (column, columns) => ({ x: middleOf(column, columns), y: bottom + 16, "text-anchor": "middle" });
  const move = drawBodies(svg, motions, namePlace, (motion, column, columns) => {
    const x = middleOf(column, columns);
    const bar = (x1, x2, y1, y2, thick) => draw(svg, "line", { x1, x2, y1, y2, stroke: "currentColor", "stroke-width": thick });
    for (const rail of motion.ghost ? [] : [x - wide / 2 - 3, x + wide / 2 + 3]) bar(rail, rail, top - 8, bottom, 2);
    if (!motion.ghost) bar(x - wide, x + wide, bottom, bottom, 3);
    const rope = motion.ghost ? null : bar(x, x, top - 8, top, 1);
    const carriage = draw(svg, "g");
    draw(carriage, "rect", { x: -wide / 2, y: -26, width: wide, height: 26, rx: 3, ...paint(motion) });
    return ({ position }) => {
      const y = bottom - (bounded(position, stage.low, stage.high) - stage.low) * scale;
      place(carriage, x, y);
      rope?.setAttribute("y2", y - 26);
    };
  });
  return { height: bottom + 24, move };
}

function drawArm(svg, stage, motions, width) {
  const height = 244;
  const reach = Math.min(width / 2 - 12, 104);
  const [x, y] = [width / 2, height / 2];
  draw(svg, "line", { x1: x - reach, x2: x + reach, y1: y, y2: y, stroke: "currentColor", "stroke-dasharray": "2 4" });
  draw(svg, "text", { x: x - reach, y: y + 15 }, "level");
  draw(svg, "rect", { x: x - 7, y, width: 14, height: height - y - 2, fill: "currentColor", opacity: 0.35 });
  const move = drawBodies(svg, motions, null, (motion) => {
    const bar = draw(svg, "g");
    draw(bar, "rect", { x: 0, y: -5, width: reach - 12, height: 10, rx: 5, ...paint(motion) });
    draw(bar, "circle", { cx: reach - 14, r: 11, ...paint(motion) });
    return ({ position }) => place(bar, x, y, -position * TURN);
  });
  draw(svg, "circle", { cx: x, cy: y, r: 6, fill: "currentColor" });
  return { height, move };
}

function drawFlywheel(svg, stage, motions, width) {
  const radius = Math.min(70, width / countSolid(motions) / 2 - 10);
  const middleOf = (column, columns) => (width * (column + 0.5)) / columns;
  const namePlace = (column, columns) => ({ x: middleOf(column, columns), y: 2 * radius + 28, "text-anchor": "middle" });
  const move = drawBodies(svg, motions, namePlace, (motion, column, columns) => {
    if (motion.ghost) return () => {};
    const wheel = draw(svg, "g");
    draw(wheel, "circle", { r: radius, fill: "none", stroke: motion.color, "stroke-width": 9 });
    for (let spoke = 0; spoke < 3; spoke++) {
      const [x2, y2] = [Math.cos, Math.sin].map((f) => radius * f((spoke * 2 * Math.PI) / 3));
      draw(wheel, "line", { x2, y2, stroke: "currentColor", "stroke-width": spoke ? 2 : 5 });
    }
    return ({ position }) => place(wheel, middleOf(column, columns), radius + 8, -position * stage.slow * TURN);
  });
  return { height: 2 * radius + 34, move };
}

/** A swerve drive from above: it goes along x and turns; its wheels point where they push. */
function drawSwerve(svg, stage, motions, width) {
  const lane = 96;
  const { toX, scale, height, namePlace } = drawFloor(svg, stage, motions, width, lane);
  const half = bounded(0.35 * scale, 18, 27);
  const move = drawBodies(svg, motions, namePlace, (motion, row) => {
    const body = draw(svg, "g");
    draw(body, "rect", { x: -half, y: -half, width: 2 * half, height: 2 * half, rx: 4, ...paint(motion) });
    draw(body, "path", { d: `M${half - 9} -6l8 6l-8 6`, fill: "none", stroke: "currentColor", "stroke-width": 2 });
    for (const [x, y] of [[1, 1], [1, -1], [-1, 1], [-1, -1]]) {
      const wheel = draw(body, "g");
      draw(wheel, "rect", {
        x: -7, y: -3, width: 14, height: 6, rx: 2, fill: "var(--motion-ground)", stroke: motion.color, "stroke-width": 1.5,
      });
      place(wheel, x * (half - 8), y * (half - 8), motion.turns ? 45 * x * y * -1 : 0);
    }
    return ({ position, heading }) => place(body, toX(position) - (stage.centered ? 0 : half), lane * (row + 0.5), -heading * TURN);
  });
  return { height, move };
}

export const STAGES = {
  drivetrain: drawDrivetrain,
  elevator: drawElevator,
  arm: drawArm,
  flywheel: drawFlywheel,
  swerve: drawSwerve,
};
