// What would take back the changes that this page has made, the newest first.
import { replacedBy, wanted, type Fields } from './fields';

/** A value that was set, and what to set in its place to have the one before. */
export interface Undo {
  readonly path: string;
  readonly set: string;
  readonly before: { readonly path: string; readonly value: string };
}

const KEPT = 50;

/** What a field would have to be set to, to be as it is now; null: it is absent, and nothing can be set to that. */
export function restoring(fields: Fields, path: string): Undo['before'] | null {
  for (const place of [path, replacedBy(path)]) {
    const field = place === null ? undefined : fields.get(place);
    const value = field === undefined ? '' : wanted(field);
    if (field !== undefined && value !== '') return { path: field.path, value };
  }
  return null;
}

/** Steps that are still as they were set: nobody has changed the field since. */
export function standing(steps: readonly Undo[], fields: Fields): readonly Undo[] {
  return steps.filter(({ path, set }) => {
    const field = fields.get(path);
    return field !== undefined && wanted(field) === set;
  });
}

/** Groups of steps that were set together. */
export function pushed(undos: readonly (readonly Undo[])[], steps: readonly Undo[]): readonly (readonly Undo[])[] {
  return steps.length === 0 ? undos : [...undos, steps].slice(-KEPT);
}
