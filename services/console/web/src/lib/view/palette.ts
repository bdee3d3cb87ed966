// Colours of the drawing, in both themes. Chosen so that equipped and unequipped differ in lightness as well as in hue.

export const THEMES = ['light', 'dark'] as const;
export type Theme = (typeof THEMES)[number];

export interface Palette {
  ground: string;
  asphalt: string;
  marking: string;
  centreLine: string;
  crossing: string;
  label: string;
  equipped: string;
  unequipped: string;
  roofMark: string;
  glass: string;
  brake: string;
  outline: string;
  advice: string;
  selected: string;
  lost: string;
  head: string;
  red: string;
  yellow: string;
  green: string;
  unknown: string;
}

export const PALETTES: Record<Theme, Palette> = {
  light: {
    ground: '#e8ebe6',
    asphalt: '#b9bfc6',
    marking: '#fbfcfd',
    centreLine: '#d9a514',
    crossing: '#d3d8dd',
    label: '#3c4652',
    equipped: '#1f5fbf',
    unequipped: '#e2562b',
    roofMark: '#ffffff',
    glass: '#12202e',
    brake: '#ff1f3d',
    outline: '#ffffff',
    advice: '#0b8f8a',
    selected: '#111111',
    lost: '#8a1fa8',
    head: '#1c232b',
    red: '#f0453a',
    yellow: '#f5b921',
    green: '#35c46f',
    unknown: '#68727c',
  },
  dark: {
    ground: '#12171c',
    asphalt: '#2b333c',
    marking: '#8e99a5',
    centreLine: '#b58a1a',
    crossing: '#3a444f',
    label: '#b9c3cd',
    equipped: '#5aa2ff',
    unequipped: '#ff7a4d',
    roofMark: '#ffffff',
    glass: '#0a1016',
    brake: '#ff2f4b',
    outline: '#0d1115',
    advice: '#3fd6cd',
    selected: '#ffffff',
    lost: '#d98bf0',
    head: '#06090c',
    red: '#ff5b4f',
    yellow: '#ffc93c',
    green: '#43d880',
    unknown: '#7c8792',
  },
};

/** Seven kinds that are told apart by hue and lightness (after Okabe and Ito). */
export const REGIME_COLOURS = ['#9a86d6', '#e69f00', '#d55e00', '#0072b2', '#f0e442', '#b3202a', '#009e73'] as const;

/** A scale of five colours from dark to light (the bends of "viridis"). */
const SCALE = [
  [68, 1, 84],
  [59, 82, 139],
  [33, 145, 140],
  [94, 201, 98],
  [253, 231, 37],
] as const;

/** Colour of a share in [0, 1]. */
export function scaleColour(share: number): string {
  const bounded = Math.min(1, Math.max(0, share)) * (SCALE.length - 1);
  const low = Math.min(SCALE.length - 2, Math.floor(bounded));
  const part = bounded - low;
  const mix = SCALE[low].map((from, i) => Math.round(from + (SCALE[low + 1][i] - from) * part));
  return `rgb(${mix.join(',')})`;
}
