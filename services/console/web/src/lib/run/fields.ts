// The fields that may change while a run goes on: their value in force, the one that is on its way, and what was refused.
import type { LiveField } from '../../generated/console_pb';

export interface FieldState {
  readonly path: string;
  readonly unit: string;
  readonly min: number | null;
  readonly max: number | null;
  readonly source: string;
  readonly words: readonly string[];
  readonly initial: string; // that the run began with
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
        initial: f.initial,
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
  const others = replacedBy(path) === null ? fields : changed(fields, replacedBy(path)!, { value: '', coming: null });
  if (step <= shown) return changed(others, path, { value, coming: null, asked: null, refusal: '' });
  return changed(others, path, { coming: { value, step }, asked: null, refusal: '' });
}

/** A plan stands in the place of a preset, and the other way round. */
export function replacedBy(path: string): string | null {
  if (path === 'signals.plan') return 'signals.preset';
  return path === 'signals.preset' ? 'signals.plan' : null;
}

/** The fields of a recording as they were at `step`; `changes` in their order. */
export function fieldsAt(live: readonly LiveField[], changes: readonly Change[], step: number): Fields {
  const begin: Fields = fieldsOf(live.map((field) => ({ ...field, value: field.initial })));
  return changes
    .filter((change) => change.step <= step)
    .reduce((fields, change) => directed(fields, change.text, change.step, step), begin);
}

export interface Change {
  readonly step: number;
  readonly text: string; // "path=value"
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

export const flowPath = (approach: string) => `traffic.${approach}.flow_veh_per_h`;
/** Where the sliders of flows end; more can be typed. */
export const FLOW_SLIDER_VEH_PER_H = 3600;

/** Values with the mean `mean` in the proportions that the fields have now; alike if all are 0 or `alike`. */
export function spread(fields: readonly FieldState[], mean: number, alike: boolean): { path: string; value: string }[] {
  const values = fields.map((field) => Number(wanted(field)));
  const sum = values.reduce((a, b) => a + b, 0);
  return fields.map(({ path, max }, i) => {
    const share = alike || sum === 0 ? 1 : (values[i] * fields.length) / sum;
    return { path, value: String(Math.min(max ?? Infinity, Math.round(mean * share))) };
  });
}

/** Beyond this a range is no limit: it reaches over every road. */
const NO_LIMIT_M = 10_000;

/** How far the RSUs are heard [m]; null if no limit is set. */
export function rangeOf(fields: Fields): number | null {
  const rangeM = Number(fields.get('radio.downlink.range_m')?.value ?? '');
  return rangeM > 0 && rangeM < NO_LIMIT_M ? rangeM : null;
}
