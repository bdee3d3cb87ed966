import { en, type Key } from '@page/lib/i18n/en';
import { zh } from '@page/lib/i18n/zh';
import { t, tOr, words } from '@page/lib/i18n/words.svelte';

const placesIn = (text: string) => [...text.matchAll(/\{(\w+)\}/g)].map((match) => match[1]).sort();

describe('the words', () => {
  it('are the same keys in both languages', () => {
    expect(Object.keys(zh).sort()).toEqual(Object.keys(en).sort());
  });

  it('take the same values in both languages', () => {
    for (const key of Object.keys(en) as Key[]) expect([key, placesIn(zh[key])]).toEqual([key, placesIn(en[key])]);
  });

  it('are never empty', () => {
    for (const table of [en, zh]) expect(Object.values(table).filter((text) => text.trim() === '')).toEqual([]);
  });

  it('are those of the chosen language, with values filled in', () => {
    words.language = 'zh';
    expect(t('card.title', { n: 12 })).toBe('车辆 12');
    words.language = 'en';
    expect(t('card.title', { n: 12 })).toBe('Car 12');
    expect(tOr('fate.99', 'unknown')).toBe('unknown');
  });
});
