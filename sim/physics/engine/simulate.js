// One run, simulated with the gains on the sliders: the same exact step as sim/physics/engine.
//
//     kA·v' = u - kV·v - gravity - kS·sgn(v)
//
// The linear part has an exact solution (an exponential), and friction's change of sign is met at
// its exact time. Everything is in SI: seconds, volts, meters or radians.

const ARM_STEP = 0.005; // [s] gravity of an arm changes on the way; no step is longer

/** A mechanism's gains in SI; null where nothing can move with them. */
export function makeModel(type, gains, { lag = 0, window = 0 } = {}) {
  const way = gains.kV < 0 && gains.kA < 0 ? -1 : 1;
  const [kV, kA, kG] = [way * gains.kV, way * gains.kA, way * (gains.kG ?? 0)];
  if (!(kV > 0 && kA > 0)) return null;
  return {
    way, kV, kA, lag, window,
    kS: Math.max(way * gains.kS, 0),
    load: type === "elevator" ? kG : 0,
    level: type === "arm" ? kG : 0,
    angle: gains.offset_rad ?? 0,
  };
}

/**
 * Position and velocity of a run under its recorded voltage, open loop.
 *
 * @param run {time, voltage}: arrays of the same length; a voltage holds until the next.
 * @param start {position, velocity} at the first sample.
 * @returns {position, velocity}: the velocity as the sensor would report it.
 */
export function simulateRun(run, model, start) {
  const { time, voltage } = run;
  const n = time.length;
  const position = new Float64Array(n);
  const moved = new Float64Array(n);
  const state = { x: start.position, v: start.velocity };
  const rests = state.v === 0;
  let command = -1;
  for (let k = 0; k < n; k++) {
    let now = time[k];
    while (command + 1 < n && time[command + 1] + model.lag <= now + 1e-12) command++;
    position[k] = state.x;
    moved[k] = state.v;
    if (k === n - 1) break;
    while (now < time[k + 1] - 1e-12) {
      const arrives = command + 1 < n ? time[command + 1] + model.lag : Infinity;
      const after = Math.min(time[k + 1], arrives);
      if (command >= 0 || !rests) {
        advance(state, model, command < 0 ? 0 : model.way * voltage[command], after - now);
      }
      now = after;
      while (command + 1 < n && time[command + 1] + model.lag <= now + 1e-12) command++;
    }
  }
  return { position, velocity: averageVelocity(time, position, moved, model.window) };
}

/** Root of the mean square of what is left between a measured and a simulated curve. */
export function rms(measured, simulated) {
  let sum = 0;
  for (let k = 0; k < simulated.length; k++) sum += (measured[k] - simulated[k]) ** 2;
  return Math.sqrt(sum / Math.max(simulated.length, 1));
}

function advance(state, model, volts, span) {
  if (model.level === 0) {
    moveExactly(state, model, volts - model.load, span);
    return;
  }
  const count = Math.max(Math.ceil(span / ARM_STEP - 1e-9), 1);
  const dt = span / count;
  for (let i = 0; i < count; i++) {
    const middle = predictMiddle(state, model, volts - gravity(model, state.x), 0.5 * dt);
    moveExactly(state, model, volts - gravity(model, middle), dt);
  }
}

function gravity(model, x) {
  return model.level * Math.cos(x + model.angle);
}

/** Where a step has its middle, along a straight line. */
function predictMiddle({ x, v }, model, drive, dt) {
  const way = Math.sign(v !== 0 ? v : drive) || 1;
  if (v === 0 && Math.abs(drive) <= model.kS) return x;
  let after = v + (dt * (drive - way * model.kS - model.kV * v)) / model.kA;
  if (v * after < 0) after = 0;
  return x + 0.5 * dt * (v + after);
}

/** Position and velocity after a time under a constant drive [V], turning points included. */
function moveExactly(state, model, drive, span) {
  const rate = model.kV / model.kA;
  let { x, v } = state;
  let left = span;
  while (left > 0) {
    let way = Math.sign(v);
    if (v === 0) {
      if (Math.abs(drive) <= model.kS) break; // friction holds it
      way = Math.sign(drive);
    }
    const push = (drive - way * model.kS) / model.kA;
    let until = Infinity;
    if (v !== 0 && push * way < 0) { // it slows down, and may turn
      const inside = (-v * rate) / push;
      if (Math.abs(inside) < 1e-9) until = -v / push;
      else if (inside > -1) until = Math.log1p(inside) / rate;
    }
    const step = Math.min(left, until);
    const lost = -Math.expm1(-rate * step);
    const reach = Math.abs(rate * step) < 1e-9 ? step : lost / rate;
    const rest = Math.abs(rate * step) < 1e-5 ? 0.5 * step * step : (step - reach) / rate;
    x += v * reach + push * rest;
    v = until <= left ? 0 : v * (1 - lost) + push * reach;
    left -= step;
  }
  state.x = x;
  state.v = v;
}

/** The velocity of a sensor that reports the mean of the last `window` seconds. */
function averageVelocity(time, position, velocity, window) {
  if (!(window > 1e-5)) return velocity;
  const seen = new Float64Array(velocity);
  for (let now = 1, k = 0; now < time.length; now++) {
    const began = time[now] - window;
    let back;
    if (began <= time[0]) {
      back = position[0] + velocity[0] * (began - time[0]);
    } else {
      while (time[k + 1] <= began) k++;
      const span = time[k + 1] - time[k];
      const part = (began - time[k]) / span;
      const rest = 1 - part;
      back = rest * rest * ((1 + 2 * part) * position[k] + part * span * velocity[k])
        + part * part * ((1 + 2 * rest) * position[k + 1] - rest * span * velocity[k + 1]);
    }
    seen[now] = (position[now] - back) / window;
  }
  return seen;
}
