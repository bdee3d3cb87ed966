// The page's language.
import { en, type Key } from './en';
import { zh } from './zh';

export type Language = 'en' | 'zh';
const TABLES: Record<Language, Record<Key, string>> = { en, zh };

export const words = $state<{ language: Language }>({ language: 'en' });

/** The text of a key in the page's language; {name} stands for a value. */
export function t(key: Key, values: Record<string, string | number> = {}): string {
  return filled(TABLES[words.language][key], values);
}

/** The text of a key that is put together, such as one that comes with a number over the wire; `otherwise` if there is none. */
export function tOr(key: string, otherwise: string): string {
  return (TABLES[words.language] as Record<string, string>)[key] ?? otherwise;
}

function filled(text: string, values: Record<string, string | number>): string {
  return text.replace(/\{(\w+)\}/g, (whole, name: string) => String(values[name] ?? whole));
}
