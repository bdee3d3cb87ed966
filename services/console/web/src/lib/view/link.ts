// What one looks at, as the part of the page's address behind "#": a link to it restores the view.
//   #panel=signals&colour=speed&radio&reach=34.5&centre=12,-40.5&car=1136&follow&lane=SC&lang=zh&theme=dark
import type { Language } from '../i18n/words.svelte';
import { LANES } from '../wire/scene';
import { COLOURINGS, type Colouring } from './colouring';
import { THEMES, type Theme } from './palette';
import type { Place } from './path';
import { TABS, type Tab } from './view_state.svelte';

/** Half of the picture's shorter side [m], and its middle; without a middle that of the junction. */
export interface Section {
  readonly reachM: number;
  readonly centre: Place | null;
}

export interface Sight {
  readonly tab: Tab;
  readonly colouring: Colouring;
  readonly radio: boolean;
  readonly section: Section;
  readonly car: number | null;
  readonly follow: boolean;
  readonly lane: number | null; // that is chosen in the signal plan
  readonly language: Language;
  readonly theme: Theme;
}

const rounded = (metres: number) => String(Math.round(metres * 10) / 10);

export function linkOf(sight: Sight): string {
  const { tab, colouring, radio, section, car, follow, lane, language, theme } = sight;
  const words = [`panel=${tab}`, `colour=${colouring}`];
  if (radio) words.push('radio');
  words.push(`reach=${rounded(section.reachM)}`);
  if (section.centre !== null && !follow) {
    words.push(`centre=${rounded(section.centre.xM)},${rounded(section.centre.yM)}`);
  }
  if (car !== null) words.push(`car=${car}`);
  if (car !== null && follow) words.push('follow');
  if (lane !== null) words.push(`lane=${LANES[lane]}`);
  return `#${[...words, `lang=${language}`, `theme=${theme}`].join('&')}`;
}

/** What a link says; what it does not say, or says wrongly, is left out. */
export function sightIn(fragment: string): Partial<Sight> {
  const said = new URLSearchParams(fragment.replace(/^#/, ''));
  const among = <T extends string>(name: string, all: readonly T[]) => all.find((word) => word === said.get(name));
  const number = (text: string | undefined | null) => (text == null || text === '' ? NaN : Number(text));
  const sight: { -readonly [K in keyof Sight]?: Sight[K] } = {};
  const tab = among('panel', TABS);
  const colouring = among('colour', COLOURINGS);
  const theme = among('theme', THEMES);
  const language = among('lang', ['en', 'zh'] as const);
  if (tab !== undefined) sight.tab = tab;
  if (colouring !== undefined) sight.colouring = colouring;
  if (theme !== undefined) sight.theme = theme;
  if (language !== undefined) sight.language = language;
  if (said.has('radio')) sight.radio = true;
  const lane = LANES.findIndex((name) => name === said.get('lane'));
  if (lane >= 0) sight.lane = lane;
  const car = number(said.get('car'));
  if (Number.isInteger(car) && car >= 0) sight.car = car;
  if (sight.car !== undefined && said.has('follow')) sight.follow = true;
  const reachM = number(said.get('reach'));
  if (reachM > 0 && reachM < 1e5) {
    const [xM, yM] = (said.get('centre') ?? '').split(',').map(number);
    const centre = Number.isFinite(xM) && Number.isFinite(yM) ? { xM, yM } : null;
    sight.section = { reachM, centre };
  }
  return sight;
}

/** The address of the page with this sight, without the token: who follows the link has to have it. */
export function addressOf(address: string, fragment: string): string {
  const url = new URL(address);
  url.searchParams.delete('token');
  url.hash = fragment;
  return url.href;
}
