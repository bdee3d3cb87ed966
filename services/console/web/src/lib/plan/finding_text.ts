// Findings in words.
import type { Finding } from './checks';
import { secondsText } from './textproto';
import type { Key } from '../i18n/en';

/** Key of the page's words and their values for a finding. */
export function wordsOf(finding: Finding): [Key, Record<string, string | number>] {
  switch (finding.kind) {
    case 'hard':
    case 'permitted': {
      const { a, b, from, to } = finding;
      return [`find.${finding.kind}`, { a, b, from: secondsText(from), to: secondsText(to) }];
    }
    case 'no_clearance': {
      const { a, b, gap, pairs } = finding;
      return ['find.no_clearance', { a, b, pairs, gap: secondsText(gap) }];
    }
    case 'short_green':
      return ['find.short_green', { lane: finding.lane, s: secondsText(finding.steps) }];
    case 'never_green':
      return ['find.never_green', { lane: finding.lane }];
    case 'no_yellow':
      return ['find.no_yellow', { n: finding.lanes }];
  }
}
