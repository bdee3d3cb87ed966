// The fields that may change while a run goes on: their value in force, the one that is on its way, and what was refused.
import type { LiveField } from '../../generated/console_pb';

export interface FieldState {
  readonly path: string;
  readonly unit: string;
  readonly min: number | null;
  readonly max: number | null;
  readonly source: string;
  readonly words: readonly string[];
  readonly value: string; // in force
  readonly coming: { value: string; step: number } | null; // accepted, in force from `step` on
  readonly asked: string | null; // sent, not answered yet
  readonly refusal: string;
}

/** What the field will hold when everything under way has arrived. */
export function wanted(field: FieldState): string {
  return field.asked ?? field.coming?.value ?? field.value;
}

export type Fields = ReadonlyMap<string, FieldState>;

export function fieldsOf(live: readonly LiveField[]): Map<string, FieldState> {
  return new Map(
    live.map((f) => [
      f.path,
      {
        path: f.path,
        unit: f.unit,
        min: f.min ?? null,
        max: f.max ?? null,
        source: f.source,
        words: f.words,
        value: f.value,
        coming: null,
        asked: null,
        refusal: '',
      },
    ]),
  );
}

function changed(fields: Fields, path: string, change: Partial<FieldState>): Fields {
  const field = fields.get(path);
  return field === undefined ? fields : new Map(fields).set(path, { ...field, ...change });
}

export function asked(fields: Fields, path: string, value: string): Fields {
  return changed(fields, path, { asked: value, refusal: '' });
}

export function refusedWith(fields: Fields, path: string, text: string): Fields {
  return changed(fields, path, { asked: null, refusal: text });
}

/** A directive "path=value" that acts from `step` on; `shown`: the newest step that the page has. */
export function directed(fields: Fields, text: string, step: number, shown: number): Fields {
  const directive = directiveIn(text);
  if (directive === null) return fields;
  const { path, value } = directive;
  if (step <= shown) return changed(fields, path, { value, coming: null, asked: null, refusal: '' });
  return changed(fields, path, { coming: { value, step }, asked: null, refusal: '' });
}

/** Values whose step has come are in force. */
export function arrivedAt(fields: Fields, shown: number): Fields {
  let result = fields;
  for (const [path, { coming }] of fields) {
    if (coming !== null && coming.step <= shown) result = changed(result, path, { value: coming.value, coming: null });
  }
  return result;
}

export function directiveIn(text: string): { path: string; value: string } | null {
  const at = text.indexOf('=');
  return at <= 0 ? null : { path: text.slice(0, at).trim(), value: text.slice(at + 1).trim() };
}

/** Beyond this a range is no limit: it reaches over every road. */
const NO_LIMIT_M = 10_000;

/** How far the RSUs are heard [m]; null if no limit is set. */
export function rangeOf(fields: Fields): number | null {
  const rangeM = Number(fields.get('radio.downlink.range_m')?.value ?? '');
  return rangeM > 0 && rangeM < NO_LIMIT_M ? rangeM : null;
}
