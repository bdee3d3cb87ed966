// Events in words.
import type { Note } from '../run/console.svelte';
import { said } from './said';
import { tOr } from './words.svelte';

/** In a line; a whole plan in it is left out. */
export function noteText({ kind, text: whole }: Note): string {
  const text = whole.replace(/=\{.{20,}\}/, '={…}');
  switch (kind) {
    case 'phase':
      return tOr(`phase.${text}`, said(text));
    case 'lost': {
      // "ROLE how", or the role alone.
      const role = text.split(' ', 1)[0];
      return text === role ? role : `${role} ${said(text.slice(role.length + 1))}`;
    }
    case 'directive':
      return text;
    default:
      return said(text.replace(/^\S+={…}: /, ''));
  }
}
