// What the server says in words, in the page's language. It says it in English; what no table knows stays as it is.
import { PARTS, SENTENCES } from './said_zh';
import { words } from './words.svelte';

interface Pattern {
  readonly matches: RegExp;
  readonly chinese: string;
}

const PLACE = /\{(\w+)\}/g;
/** Names of fields have no spaces: what stands before "where: " is not taken for one. */
const CATCHES: Record<string, string> = {
  path: '\\S+?',
  owner: 'a scenario|\\S+?',
  lane: '\\w\\w',
  other: '\\w\\w|[\\w.]+',
  last: '\\S+',
  t: '[\\d.]+',
};

function patternOf([english, chinese]: readonly [string, string]): Pattern {
  const parts = english.split(PLACE);
  const escaped = parts.map((part, i) =>
    i % 2 === 0 ? part.replace(/[.*+?^${}()|[\]\\]/g, '\\$&') : `(?<${part}>${CATCHES[part] ?? '.+?'})`,
  );
  return { matches: new RegExp(`^${escaped.join('')}$`, 's'), chinese };
}

/** Made when they are needed first. */
let patterns: { sentences: readonly Pattern[]; all: readonly Pattern[] } | null = null;

/** The sentence in the page's language. */
export function said(text: string): string {
  return words.language === 'zh' ? chineseOf(text) : text;
}

export function chineseOf(text: string): string {
  if (patterns === null) {
    const sentences = SENTENCES.map(patternOf);
    patterns = { sentences, all: [...PARTS.map(patternOf), ...sentences] };
  }
  return text.split('\n').map(line).join('\n');
}

/** A sentence, perhaps after the place that it speaks of: "where: what". */
function line(text: string): string {
  for (let from = 0; from >= 0;) {
    const found = filled(text.slice(from), patterns!.sentences);
    if (found !== null) return placed(text.slice(0, from)) + found;
    const next = text.indexOf(': ', from);
    from = next < 0 ? -1 : next + 2;
  }
  return text;
}

const placed = (where: string) => where.replace(/lane (\w\w): $/, '车道 $1: ').replace(/^line (\d+): $/, '第 $1 行: ');

function filled(text: string, among: readonly Pattern[]): string | null {
  for (const { matches, chinese } of among) {
    const match = matches.exec(text);
    if (match !== null) return chinese.replace(PLACE, (whole, name: string) => caught(match.groups?.[name] ?? whole));
  }
  return null;
}

/** A part of a sentence, or a list of such. */
function caught(text: string): string {
  const whole = filled(text, patterns!.all);
  if (whole !== null) return whole;
  const parts = text.split(', ').map((part) => filled(part, patterns!.all));
  return parts.every((part) => part !== null) ? parts.join('；') : text;
}
