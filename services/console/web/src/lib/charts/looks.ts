// How the lines of the charts look, in both themes. Lines are told apart by dashes, too.
import type { Theme } from '../view/palette';
import type { Line } from './plot';

const GROUP_COLOURS = { light: ['#3b4652', '#1f5fbf', '#c94a20'], dark: ['#c3ccd6', '#5aa2ff', '#ff7a4d'] };
const SIDE_COLOURS = {
  light: ['#1f5fbf', '#12703f', '#b3261e', '#7a3fa8'],
  dark: ['#6aabff', '#5fd694', '#ff8a80', '#c99bf0'],
};
const TURN_DASHES = [[6, 3], [], [2, 2]];

/** All cars, the equipped, the others; of two lines the first two, one alone is blue. */
export function groupLines(labels: readonly string[], theme: Theme): Line[] {
  const colours = GROUP_COLOURS[theme];
  return labels.map((label, i) => ({
    label,
    stroke: colours[labels.length === 1 ? 1 : i],
    dash: i === 2 ? [5, 3] : undefined,
  }));
}

/** The twelve lanes: a colour for each approach, a dash for each turn. */
export function laneLines(labels: readonly string[], theme: Theme): Line[] {
  return labels.map((label, i) => ({
    label,
    stroke: SIDE_COLOURS[theme][Math.floor(i / 3)],
    dash: TURN_DASHES[i % 3],
  }));
}

export function ghostLine(label: string): Line {
  return { label, stroke: '#8b97a3', width: 3 };
}
