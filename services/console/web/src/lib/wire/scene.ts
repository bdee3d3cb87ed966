// A picture of one step, as the page keeps it: typed arrays, a tenth of the size of the decoded message.
import type { Picture, SignalProgram } from '../../generated/console_pb';

export const LANES = ['WL', 'WC', 'WR', 'SL', 'SC', 'SR', 'EL', 'EC', 'ER', 'NL', 'NC', 'NR'] as const;
export const APPROACHES = ['west', 'south', 'east', 'north'] as const;

export const RED = 1;
export const YELLOW = 2;
export const GREEN = 3;

/** No word was missed: the value of `missed` then. */
export const NOTHING_MISSED = 255;
/** Of a car's newest message to the roadside: heard by an RSU, or it has sent none; what lies between is how it was lost. */
export const HEARD = 0;
export const NOT_SENT = 255;
/** How messages are lost: 1 + place here. As in radio.csv. */
export const LOSS_CAUSES = ['random', 'burst', 'range', 'path_loss', 'collision', 'half_duplex', 'outage'] as const;
/** State of a car that has crossed its stop line. */
export const CROSSED = 3;
/** Guidance states that the page tells apart in its drawing. */
export const ADVICE_IN_FORCE = 2;

export interface Scene {
  step: number;
  vehicle: Uint32Array;
  lane: Uint8Array;
  equipped: Uint8Array;
  positionM: Float32Array;
  speedMps: Float32Array;
  accelerationMps2: Float32Array;
  commandedMps2: Float32Array; // NaN: no advice in force
  state: Uint8Array;
  guidance: Uint8Array;
  boundBy: Uint8Array;
  missed: Uint8Array;
  stoodS: Float32Array;
  adviceAge: Int32Array; // steps; -1: never one
  uplink: Uint8Array; // HEARD, 1 + place in LOSS_CAUSES, or NOT_SENT
  heardAge: Int32Array; // steps since the newest message that an RSU has heard was sent; -1: none was
  heads: Uint8Array;
  changeIn: Int32Array; // steps; -1: not known
  nextAspect: Uint8Array;
  waiting: readonly number[];
  program: SignalProgram | null;
  programFrom: number; // a step at which a cycle of the program begins
}

/** `before`: the scene before this one, whose program still holds when the picture brings none. */
export function sceneOf(picture: Picture, before: Scene | null): Scene {
  return {
    step: Number(picture.step),
    vehicle: Uint32Array.from(picture.vehicle),
    lane: picture.lane.slice(),
    equipped: picture.equipped.slice(),
    positionM: Float32Array.from(picture.positionM),
    speedMps: Float32Array.from(picture.speedMps),
    accelerationMps2: Float32Array.from(picture.accelerationMps2),
    commandedMps2: Float32Array.from(picture.commandedMps2),
    state: picture.state.slice(),
    guidance: picture.guidance.slice(),
    boundBy: picture.boundBy.slice(),
    missed: picture.missed.slice(),
    stoodS: Float32Array.from(picture.stoodS),
    adviceAge: Int32Array.from(picture.adviceAge),
    uplink: picture.uplink.slice(),
    heardAge: Int32Array.from(picture.heardAge),
    heads: picture.heads.slice(),
    changeIn: Int32Array.from(picture.changeIn),
    nextAspect: picture.nextAspect.slice(),
    waiting: picture.waiting,
    program: picture.program ?? before?.program ?? null,
    programFrom: picture.program ? Number(picture.programFrom) : (before?.programFrom ?? 0),
  };
}

/** Place of a vehicle in a scene, or -1. */
export function indexOf(scene: Scene, vehicle: number): number {
  return scene.vehicle.indexOf(vehicle);
}

/** Place of the car ahead on the same lane, or -1: cars stand lane after lane, front to back. */
export function aheadOf(scene: Scene, index: number): number {
  return index > 0 && scene.lane[index - 1] === scene.lane[index] ? index - 1 : -1;
}

/** How the newest message to the roadside of a car was lost; null: it was not. */
export function uplinkLoss(scene: Scene, index: number): (typeof LOSS_CAUSES)[number] | null {
  return LOSS_CAUSES[scene.uplink[index] - 1] ?? null;
}

/** The cars with advice in force, and how many of them each kind of bound decided over in this step. */
export function guidedBy(scene: Scene): { cars: number; bounds: [bound: number, cars: number][] } {
  const counts = new Map<number, number>();
  let cars = 0;
  scene.guidance.forEach((state, i) => {
    if (state !== ADVICE_IN_FORCE) return;
    ++cars;
    counts.set(scene.boundBy[i], (counts.get(scene.boundBy[i]) ?? 0) + 1);
  });
  return { cars, bounds: [...counts].sort((a, b) => b[1] - a[1]) };
}

export function laneName(lane: number): string {
  return LANES[lane] ?? '?';
}
