// The cars of a moment between two scenes.
import type { Scene } from '../wire/scene';
import { SMOOTH_STEPS } from './playback';

/** Positions to draw: of `scene`, place by place, at the moment. */
export interface Moment {
  scene: Scene;
  positionM: Float32Array;
}

/**
 * The moment `step` (with its fraction) between `before` and `after`. The properties are those of the scene that is over or at
 * hand (`before`), positions lie between both. A car that only `before` knows goes on at its speed, so that nothing jumps.
 */
export function momentBetween(before: Scene, after: Scene | null, step: number, stepS: number): Moment {
  const span = after === null ? 0 : after.step - before.step;
  if (after === null || span <= 0 || span > SMOOTH_STEPS || step <= before.step) {
    return { scene: before, positionM: before.positionM };
  }
  if (step >= after.step) return { scene: after, positionM: after.positionM };
  const share = (step - before.step) / span;
  const places = placesOf(after);
  const positionM = new Float32Array(before.vehicle.length);
  for (let i = 0; i < positionM.length; ++i) {
    const from = before.positionM[i];
    const j = places.get(before.vehicle[i]);
    const to = j === undefined ? from + before.speedMps[i] * span * stepS : after.positionM[j];
    positionM[i] = from + (to - from) * share;
  }
  return { scene: before, positionM };
}

const known = new WeakMap<Scene, Map<number, number>>();

function placesOf(scene: Scene): Map<number, number> {
  let places = known.get(scene);
  if (places === undefined) {
    places = new Map();
    for (let i = 0; i < scene.vehicle.length; ++i) places.set(scene.vehicle[i], i);
    known.set(scene, places);
  }
  return places;
}
