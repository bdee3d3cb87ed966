// What a car's colour says.
import type { Scene } from '../wire/scene';
import { REGIME_COLOURS, scaleColour, type Palette } from './palette';

export const COLOURINGS = ['equipped', 'speed', 'waiting', 'regime', 'age', 'heard'] as const;
export type Colouring = (typeof COLOURINGS)[number];

/** Upper ends of the scales. */
export const WAITING_FULL_S = 60;
export const AGE_FULL_STEPS = 50;

/** Colours of a scale are drawn in so many shades, so that cars of a shade are drawn together. */
const SHADES = 32;
const shades = Array.from({ length: SHADES + 1 }, (_, i) => scaleColour(i / SHADES));

function shade(share: number): string {
  return shades[Math.round(Math.min(1, Math.max(0, share)) * SHADES)];
}

function aged(steps: number, palette: Palette): string {
  return steps < 0 ? palette.unknown : shade(1 - steps / AGE_FULL_STEPS);
}

export function carColour(
  scene: Scene,
  index: number,
  colouring: Colouring,
  palette: Palette,
  speedLimitMps: number,
): string {
  switch (colouring) {
    case 'equipped':
      return scene.equipped[index] ? palette.equipped : palette.unequipped;
    case 'speed':
      return shade(scene.speedMps[index] / speedLimitMps);
    case 'waiting':
      return shade(scene.stoodS[index] / WAITING_FULL_S);
    case 'regime':
      return REGIME_COLOURS[scene.boundBy[index]] ?? palette.unknown;
    case 'age':
      return aged(scene.adviceAge[index], palette);
    case 'heard':
      return aged(scene.heardAge[index], palette);
  }
}
