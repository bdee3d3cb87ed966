// What the stored pictures say of one car's last minute.
import { aheadOf, NOTHING_MISSED, uplinkLoss, type Scene } from '../wire/scene';
import type { ThinningRing } from './ring';

export interface PlanePoint {
  closingMps: number; // own speed less that of the car ahead
  gapM: number; // head to head
  aheadMps: number; // speed of the car ahead
}

/** A picture and the car's place in it. */
export interface Seen {
  readonly scene: Scene;
  readonly at: number;
}

/** The pictures with the car up to `step`, oldest first, over at most `steps`, without a break. */
export function seenOf(scenes: ThinningRing<Scene>, vehicle: number, step: number, steps: number): Seen[] {
  const seen: Seen[] = [];
  for (let i = scenes.indexAt(step); i >= 0; --i) {
    const scene = scenes.at(i);
    if (scene === null || scene.step < step - steps) break;
    const at = scene.vehicle.indexOf(vehicle);
    if (at < 0) break;
    seen.push({ scene, at });
  }
  return seen.reverse();
}

/** The car's points in the plane of figure 5; without a car ahead there is none. */
export function planeTrail(seen: readonly Seen[]): PlanePoint[] {
  return seen.map(({ scene, at }) => planePoint(scene, at)).filter((point) => point !== null);
}

export function planePoint(scene: Scene, at: number): PlanePoint | null {
  const ahead = aheadOf(scene, at);
  if (ahead < 0) return null;
  return {
    closingMps: scene.speedMps[at] - scene.speedMps[ahead],
    gapM: scene.positionM[ahead] - scene.positionM[at],
    aheadMps: scene.speedMps[ahead],
  };
}

/** Messages of one direction that were lost in the same way, in pictures that follow each other. */
export interface Loss {
  readonly up: boolean; // car to RSU
  readonly cause: string; // key of the page's words
  readonly from: number; // steps of the first and the last of these pictures
  readonly to: number;
}

/** The losses of the car in these pictures, newest first. */
export function lossesOf(seen: readonly Seen[]): Loss[] {
  const open: (Loss | null)[] = [null, null];
  const losses: Loss[] = [];
  for (const { scene, at } of seen) {
    const up = uplinkLoss(scene, at);
    const missed = scene.missed[at];
    const causes = [up === null ? null : `cause.${up}`, missed === NOTHING_MISSED ? null : `fate.${missed}`];
    causes.forEach((cause, i) => {
      const last = open[i];
      if (last !== null && last.cause !== cause) losses.push(last);
      if (cause === null) open[i] = null;
      else if (last?.cause === cause) open[i] = { ...last, to: scene.step };
      else open[i] = { up: i === 0, cause, from: scene.step, to: scene.step };
    });
  }
  return [...losses, ...open.filter((loss) => loss !== null)].sort((a, b) => b.to - a.to || b.from - a.from);
}
