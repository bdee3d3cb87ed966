// What the stored pictures say of one car's last minute, for its phase plane.
import { aheadOf, type Scene } from '../wire/scene';
import type { ThinningRing } from './ring';

export interface PlanePoint {
  closingMps: number; // own speed less that of the car ahead
  gapM: number; // head to head
}

/** The car's points in the plane of figure 5 up to `step`, oldest first, over at most `steps`; without a car ahead there is none. */
export function planeTrail(scenes: ThinningRing<Scene>, vehicle: number, step: number, steps: number): PlanePoint[] {
  const points: PlanePoint[] = [];
  for (let i = scenes.indexAt(step); i >= 0; --i) {
    const scene = scenes.at(i);
    if (scene === null || scene.step < step - steps) break;
    const at = scene.vehicle.indexOf(vehicle);
    if (at < 0) break;
    const point = planePoint(scene, at);
    if (point !== null) points.push(point);
  }
  return points.reverse();
}

export function planePoint(scene: Scene, at: number): PlanePoint | null {
  const ahead = aheadOf(scene, at);
  if (ahead < 0) return null;
  return {
    closingMps: scene.speedMps[at] - scene.speedMps[ahead],
    gapM: scene.positionM[ahead] - scene.positionM[at],
  };
}
