import { chineseOf, said } from '@page/lib/i18n/said';
import { PARTS, SENTENCES } from '@page/lib/i18n/said_zh';
import { words } from '@page/lib/i18n/words.svelte';
import { planFromText } from '@page/lib/plan/textproto';

import list from '../../../sentences.txt?raw';

/** All that the server can say; a test of the server keeps the list true. */
const sentences = list.trim().split('\n');

/** What is wrong with a plan's text, as the page itself says it. */
const ofPlans = [
  'cycle_s: 90 ~',
  'signals { plan { cycle_s: 90 }',
  'cycle_s: }',
  'cycle_s: 90 { }',
  'cycle_s 90',
  'lanes: [1 2',
  'signals: 4',
  'offset_s: 1',
  'cycle_s: 90.05',
  'cycle_s: 90 lane_plans { lanes: "XX" }',
  'cycle_s: 90 lane_plans { lanes: "WL" aspects { aspect: RED duration_s: 90 } } lane_plans { lanes: "WL" }',
  'cycle_s: 90 lane_plans { lanes: "WL" aspects { aspect: RED duration_s: 80 } }',
  'cycle_s: 90 lane_plans { lanes: "WL" aspects { aspect: BLUE duration_s: 80 } }',
  '{ cycle_s: 90 } x',
].map((text) => {
  try {
    planFromText(text);
  } catch (error) {
    return (error as Error).message;
  }
  throw new Error(`not refused: ${text}`);
});

/** English that stays English: names of fields, what was typed, what has to be typed. */
const NAMES =
  /`[^`]*`|“[^”]*”|"[^"]*"|\{[^}]*\}?\}*|\[[^\]]*\]|[\w.[\]]*[._\d][\w.[\]]*|[A-Z]{2,}\w*|path=value|veh\/h|radio\.load=/g;
const withoutNames = (text: string) => text.replace(NAMES, '');

/** The text behind the place that it speaks of. */
const what = (english: string, chinese: string) => {
  let same = 0;
  while (english[same] !== undefined && english[same] === chinese[same]) ++same;
  const cut = english.slice(0, same).lastIndexOf(': ');
  return chinese.slice(cut < 0 ? 0 : cut + 2);
};

describe('what the server says', () => {
  it('is a list', () => {
    expect(sentences.length).toBeGreaterThan(70);
  });

  it.each([...sentences, ...ofPlans])('is Chinese on the Chinese page: %s', (english) => {
    const chinese = what(english, chineseOf(english));
    expect(chinese).toMatch(/[一-鿿]/);
    // No two English words in a row are left.
    expect(withoutNames(chinese)).not.toMatch(/[a-z]{2,} [a-z]{2,}/);
  });

  it('keeps the numbers and names that it speaks of', () => {
    const english = 'traffic.west.flow_veh_per_h is 99999 veh/h, must be within [0, 10800] veh/h';
    expect(chineseOf(english)).toBe('traffic.west.flow_veh_per_h 为 99999 veh/h，须在 [0, 10800] veh/h 之内');
    expect(chineseOf('viewer 12 took control from viewer 3')).toBe('12 号观察者从 3 号观察者取得控制');
    expect(
      chineseOf(
        'signals.plan lets crossing streams go together: WL and SL at 0.0 s, WC and SC at 4.5 s; separate them, or set signals.allow_conflicts: true',
      ),
    ).toBe(
      'signals.plan 使相互冲突的车流同时放行：WL 与 SL（0.0 秒）；WC 与 SC（4.5 秒）；请将其分开，或设 signals.allow_conflicts: true',
    );
  });

  it('keeps the place that it speaks of, also of several at once', () => {
    expect(chineseOf('pause: the run is ending')).toBe('pause: 运行正在结束');
    expect(chineseOf('the run has ended\nthe run is ending')).toBe('运行已结束\n运行正在结束');
  });

  it('stays as it is if nobody knows it, and on the English page', () => {
    expect(chineseOf('something new happened: at step 5')).toBe('something new happened: at step 5');
    words.language = 'en';
    expect(said('the run has ended')).toBe('the run has ended');
    words.language = 'zh';
    expect(said('the run has ended')).toBe('运行已结束');
    words.language = 'en';
  });

  it('has no line in the tables that nobody says', () => {
    const said = [...sentences, ...ofPlans].join('\n');
    const never = [...SENTENCES, ...PARTS].filter(([english]) => {
      const pieces = english.split(/\{\w+\}/).filter((piece) => piece.trim().length > 2);
      return !pieces.every((piece) => said.includes(piece));
    });
    expect(never.map(([english]) => english)).toEqual([]);
  });
});
