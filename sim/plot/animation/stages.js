// Drawings of the mechanisms: each function draws one into an SVG and returns a function to move it.
//
//     draw(svg, stage, motions, width) -> { height, move(states) }
//
// `motions` and `states` have the same order; a state is {position, velocity, heading} at the cursor.

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

const solid = (motions) => motions.map((motion, at) => ({ ...motion, at })).filter((motion) => !motion.ghost);
const ghosts = (motions) => motions.map((motion, at) => ({ ...motion, at })).filter((motion) => motion.ghost);
const place = (element, x, y, angle = 0) =>
  element.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)}) rotate(${angle.toFixed(2)})`);

/** SVG attributes of a filled shape, or of a dashed outline. */
function paint(motion) {
  return motion.ghost
    ? { fill: "none", stroke: motion.color, "stroke-width": 1.8, "stroke-dasharray": "4 3" }
    : { fill: motion.color, stroke: "currentColor", "stroke-width": 1.2 };
}

/** A floor with a lane for each robot, seen from the side. */
function drawFloor(svg, stage, motions, width, lane) {
  const lanes = solid(motions);
  const [left, right] = [14, width - 14];
  const scale = (right - left) / (stage.high - stage.low);
  const toX = (value) => left + (Math.min(Math.max(value, stage.low), stage.high) - stage.low) * scale;
  const height = lane * lanes.length + 20;
  lanes.forEach((motion, row) => {
    const ground = lane * (row + 1) - 4;
    draw(svg, "line", { x1: left, x2: right, y1: ground, y2: ground, stroke: "currentColor" });
    if (lanes.length > 1) {
      draw(svg, "text", { x: left, y: ground - lane + 14 }, motion.name);
    }
  });
  const bottom = lane * lanes.length - 4;
  const step = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20].find((one) => (one * scale) >= 44) ?? 50;
  for (let value = Math.ceil(stage.low / step); value * step <= stage.high + 1e-9; value++) {
    const x = toX(value * step);
    draw(svg, "line", { x1: x, x2: x, y1: bottom, y2: bottom + 5, stroke: "currentColor" });
    const label = `${+(value * step).toFixed(1)}`.replace("-", "−") + (value === 0 ? " m" : "");
    draw(svg, "text", { x, y: bottom + 17, "text-anchor": "middle" }, label);
  }
  for (const mark of stage.marks) {
    const x = toX(mark.at);
    draw(svg, "line", { x1: x, x2: x, y1: 2, y2: bottom, stroke: "currentColor", "stroke-dasharray": "2 3" });
    draw(svg, "text", { x: x - 4, y: 13, "text-anchor": "end" }, mark.label);
  }
  if (stage.wall !== null) {
    const x = toX(stage.wall);
    const block = { x, y: 2, height: bottom - 2, fill: "currentColor" };
    draw(svg, "rect", { ...block, width: Math.max(width - x, 0), opacity: 0.15 });
    draw(svg, "rect", { ...block, width: 7 });
    draw(svg, "text", { x: x - 5, y: 13, "text-anchor": "end" }, "wall");
  }
  return { toX, scale, height, lanes };
}

/** A robot seen from the side, its front bumper at 0. */
function drawCar(parent, motion, long) {
  const group = draw(parent, "g");
  const tall = Math.min(Math.max(long * 0.32, 10), 16);
  const wheel = Math.min(Math.max(long * 0.16, 5), 8);
  const look = paint(motion);
  draw(group, "rect", { x: -long, y: -tall - wheel * 1.2, width: long, height: tall, rx: 3, ...look });
  const wheels = [-long + wheel * 1.4, -wheel * 1.4].map((x) => {
    const turning = draw(group, "g");
    draw(turning, "circle", { r: wheel, ...look, fill: motion.ghost ? "none" : "var(--motion-ground)" });
    if (!motion.ghost) {
      draw(turning, "path", { d: `M${-wheel} 0H${wheel}M0 ${-wheel}V${wheel}`, stroke: "currentColor" });
    }
    return { turning, x, y: -wheel };
  });
  const arrow = draw(group, "path", { fill: "none", stroke: motion.color, "stroke-width": 2.5 });
  return { group, wheels, arrow, top: -tall - wheel * 1.2 - 7, middle: -long / 2, wheel };
}

function drawDrivetrain(svg, stage, motions, width) {
  const lane = 58;
  const { toX, scale, height, lanes } = drawFloor(svg, stage, motions, width, lane);
  const long = Math.min(Math.max(0.8 * scale, 30), 56); // [px] a robot is 0.8 m long, but always visible
  const cars = lanes.flatMap((motion, row) =>
    [...ghosts(motions), motion].map((one) => ({ ...drawCar(svg, one, long), at: one.at, y: lane * (row + 1) - 4 })));
  const star = stage.wall === null ? null : draw(svg, "text", { "font-size": 26, class: "motion-hit" }, "✸");
  return {
    height,
    move(states) {
      for (const { group, wheels, arrow, at, y, top, middle, wheel } of cars) {
        const { position, velocity } = states[at];
        place(group, toX(position), y);
        for (const { turning, x, y: up } of wheels) place(turning, x, up, (position * scale * TURN) / wheel);
        const reach = Math.max(Math.min(velocity * 14, 44), -44);
        const tip = Math.sign(reach) * Math.min(5, Math.abs(reach));
        arrow.setAttribute("d", Math.abs(reach) < 1 ? ""
          : `M${middle} ${top}h${reach}m${-tip} -4l${tip} 4l${-tip} 4`);
      }
      if (star) {
        const hit = lanes.find((motion) => states[motion.at].position >= stage.wall - 1e-3);
        star.setAttribute("visibility", hit ? "visible" : "hidden");
        if (hit) place(star, toX(stage.wall) - 14, lane * (lanes.indexOf(hit) + 1) - 14);
      }
    },
  };
}

function drawElevator(svg, stage, motions, width) {
  const columns = solid(motions);
  const [top, bottom] = [24, 232];
  const scale = (bottom - top - 26) / (stage.high - stage.low);
  const wide = Math.min(56, width / columns.length - 26);
  const toY = (value) => bottom - (Math.min(Math.max(value, stage.low), stage.high) - stage.low) * scale;
  const carriages = columns.flatMap((motion, column) => {
    const x = (width * (column + 0.5)) / columns.length;
    for (const side of [-1, 1]) {
      const rail = x + side * (wide / 2 + 3);
      draw(svg, "line", { x1: rail, x2: rail, y1: top - 8, y2: bottom, stroke: "currentColor", "stroke-width": 2 });
    }
    draw(svg, "line", { x1: x - wide, x2: x + wide, y1: bottom, y2: bottom, stroke: "currentColor", "stroke-width": 3 });
    if (columns.length > 1) {
      draw(svg, "text", { x, y: bottom + 16, "text-anchor": "middle" }, motion.name);
    }
    return [...ghosts(motions), motion].map((one) => {
      const carriage = draw(svg, "g");
      const rope = one.ghost ? null : draw(svg, "line", { x1: x, x2: x, y1: top - 8, stroke: "currentColor" });
      draw(carriage, "rect", { x: -wide / 2, y: -26, width: wide, height: 26, rx: 3, ...paint(one) });
      return { carriage, rope, x, at: one.at };
    });
  });
  return {
    height: bottom + 24,
    move(states) {
      for (const { carriage, rope, x, at } of carriages) {
        const y = toY(states[at].position);
        place(carriage, x, y);
        rope?.setAttribute("y2", y - 26);
      }
    },
  };
}

function drawArm(svg, stage, motions, width) {
  const height = 244;
  const reach = Math.min(width / 2 - 12, 104);
  const [x, y] = [width / 2, height / 2];
  draw(svg, "line", { x1: x - reach, x2: x + reach, y1: y, y2: y, stroke: "currentColor", "stroke-dasharray": "2 4" });
  draw(svg, "text", { x: x - reach, y: y + 15 }, "level");
  draw(svg, "rect", { x: x - 7, y, width: 14, height: height - y - 2, fill: "currentColor", opacity: 0.35 });
  const bars = [...ghosts(motions), ...solid(motions)].map((motion) => {
    const bar = draw(svg, "g");
    draw(bar, "rect", { x: 0, y: -5, width: reach - 12, height: 10, rx: 5, ...paint(motion) });
    draw(bar, "circle", { cx: reach - 14, r: 11, ...paint(motion) });
    return { bar, at: motion.at };
  });
  draw(svg, "circle", { cx: x, cy: y, r: 6, fill: "currentColor" });
  return {
    height,
    move(states) {
      for (const { bar, at } of bars) place(bar, x, y, -states[at].position * TURN);
    },
  };
}

function drawFlywheel(svg, stage, motions, width) {
  const columns = solid(motions);
  const radius = Math.min(70, width / columns.length / 2 - 10);
  const wheels = columns.map((motion, column) => {
    const x = (width * (column + 0.5)) / columns.length;
    if (columns.length > 1) draw(svg, "text", { x, y: 2 * radius + 28, "text-anchor": "middle" }, motion.name);
    const wheel = draw(svg, "g");
    draw(wheel, "circle", { r: radius, fill: "none", stroke: motion.color, "stroke-width": 9 });
    for (let spoke = 0; spoke < 3; spoke++) {
      const [cos, sin] = [Math.cos, Math.sin].map((f) => radius * f((spoke * 2 * Math.PI) / 3));
      draw(wheel, "line", { x2: cos, y2: sin, stroke: "currentColor", "stroke-width": spoke ? 2 : 5 });
    }
    return { wheel, x, at: motion.at };
  });
  return {
    height: 2 * radius + 34,
    move(states) {
      for (const { wheel, x, at } of wheels) place(wheel, x, radius + 8, -states[at].position * stage.slow * TURN);
    },
  };
}

/** A swerve drive from above: it goes along x and turns; its wheels point where they push. */
function drawSwerve(svg, stage, motions, width) {
  const lane = 96;
  const { toX, scale, height, lanes } = drawFloor(svg, stage, motions, width, lane);
  const half = Math.min(Math.max(0.35 * scale, 18), 27);
  const robots = lanes.flatMap((motion, row) => [...ghosts(motions), motion].map((one) => {
    const body = draw(svg, "g");
    draw(body, "rect", { x: -half, y: -half, width: 2 * half, height: 2 * half, rx: 4, ...paint(one) });
    draw(body, "path", { d: `M${half - 9} -6l8 6l-8 6`, fill: "none", stroke: "currentColor", "stroke-width": 2 });
    for (const [x, y] of [[1, 1], [1, -1], [-1, 1], [-1, -1]]) {
      const wheel = draw(body, "g");
      draw(wheel, "rect", {
        x: -7, y: -3, width: 14, height: 6, rx: 2, fill: "var(--motion-ground)", stroke: one.color, "stroke-width": 1.5,
      });
      place(wheel, x * (half - 8), y * (half - 8), one.turns ? 45 * x * y * -1 : 0);
    }
    return { body, at: one.at, y: lane * (row + 0.5) };
  }));
  return {
    height,
    move(states) {
      for (const { body, at, y } of robots) {
        const { position, heading } = states[at];
        place(body, toX(position) - (stage.centered ? 0 : half), y, -heading * TURN);
      }
    },
  };
}

export const STAGES = {
  drivetrain: drawDrivetrain,
  elevator: drawElevator,
  arm: drawArm,
  flywheel: drawFlywheel,
  swerve: drawSwerve,
};
