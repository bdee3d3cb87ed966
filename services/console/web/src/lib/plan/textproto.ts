// A plan as the scenario writes it: `cycle_s: 90 lane_plans { lanes: "WL" aspects { aspect: GREEN duration_s: 45 } ... }`.
import { GREEN, LANES, RED, YELLOW } from '../wire/scene';
import { joined, type Plan, type Stretch } from './plan';
import { parseText, type Field } from './text_format';

const ASPECT_NAMES: Record<number, string> = { [RED]: 'RED', [YELLOW]: 'YELLOW', [GREEN]: 'GREEN' };
const STEPS_PER_SECOND = 10;

/** Steps as seconds: 425 is "42.5". */
export function secondsText(steps: number): string {
  return steps % STEPS_PER_SECOND === 0 ? String(steps / STEPS_PER_SECOND) : (steps / STEPS_PER_SECOND).toFixed(1);
}

/** Lanes that run the same stretches stand together. */
function groups(plan: Plan): { lanes: string[]; stretches: readonly Stretch[] }[] {
  const found = new Map<string, { lanes: string[]; stretches: readonly Stretch[] }>();
  plan.lanes.forEach((stretches, i) => {
    const key = stretches.map((s) => `${s.aspect}:${s.steps}`).join(' ');
    const group = found.get(key) ?? { lanes: [], stretches };
    group.lanes.push(LANES[i]);
    found.set(key, group);
  });
  return [...found.values()];
}

function aspectText(stretch: Stretch): string {
  return `aspects { aspect: ${ASPECT_NAMES[stretch.aspect]} duration_s: ${secondsText(stretch.steps)} }`;
}

/** One line, the value of `set signals.plan=`. */
export function planValue(plan: Plan): string {
  const lanePlans = groups(plan).map(({ lanes, stretches }) => {
    const names = lanes.map((lane) => `lanes: "${lane}"`).join(' ');
    return `lane_plans { ${names} ${stretches.map(aspectText).join(' ')} }`;
  });
  return `{cycle_s: ${secondsText(plan.cycle)} offset_s: ${secondsText(plan.offset)} ${lanePlans.join(' ')}}`;
}

/** For a scenario file. */
export function planFile(plan: Plan): string {
  const lines = ['signals {', '  plan {', `    cycle_s: ${secondsText(plan.cycle)}`];
  lines.push(`    offset_s: ${secondsText(plan.offset)}`);
  for (const { lanes, stretches } of groups(plan)) {
    lines.push('    lane_plans {', `      lanes: [${lanes.map((lane) => `"${lane}"`).join(', ')}]`);
    for (const stretch of stretches) lines.push(`      ${aspectText(stretch)}`);
    lines.push('    }');
  }
  return [...lines, '  }', '}', ''].join('\n');
}

export class PlanTextError extends Error {}

/** Reads what planFile and planValue write, and any scenario that holds a `signals { plan { ... } }`. */
export function planFromText(text: string): Plan {
  const fields = planFields(parseText(text));
  const cycle = stepsOf(fields, 'cycle_s', true);
  const lanes: Stretch[][] = LANES.map(() => []);
  for (const lanePlan of fields.filter((f) => f.name === 'lane_plans')) {
    const inside = messageOf(lanePlan);
    const stretches = inside.filter((f) => f.name === 'aspects').map(stretchOf);
    for (const { value } of inside.filter((f) => f.name === 'lanes')) {
      const lane = (LANES as readonly string[]).indexOf(String(value));
      if (lane < 0) throw new PlanTextError(`"${String(value)}" is not a lane; lanes are ${LANES.join(' ')}`);
      if (lanes[lane].length > 0) throw new PlanTextError(`${LANES[lane]} stands twice`);
      lanes[lane] = joined(stretches);
    }
  }
  lanes.forEach((lane, i) => {
    const sum = lane.reduce((steps, stretch) => steps + stretch.steps, 0);
    if (sum !== cycle) {
      throw new PlanTextError(`${LANES[i]} adds up to ${secondsText(sum)} s, the cycle is ${secondsText(cycle)} s`);
    }
  });
  return { cycle, offset: stepsOf(fields, 'offset_s', false), lanes };
}

/** The fields of the plan, whether the text is a plan, a `plan`, a `signals` or a whole scenario. */
function planFields(fields: Field[]): Field[] {
  for (const name of ['signals', 'plan']) {
    const found = fields.find((field) => field.name === name);
    if (found !== undefined) return planFields(messageOf(found));
  }
  return fields;
}

function messageOf(field: Field): Field[] {
  if (!Array.isArray(field.value)) throw new PlanTextError(`${field.name} must be { ... }`);
  return field.value;
}

function stepsOf(fields: Field[], name: string, required: boolean): number {
  const field = fields.find((f) => f.name === name);
  if (field === undefined) {
    if (required) throw new PlanTextError(`${name} is missing`);
    return 0;
  }
  const value = Number(field.value);
  const steps = Math.round(value * STEPS_PER_SECOND);
  const least = required ? 1 : 0;
  if (!Number.isFinite(value) || steps < least || steps > 36_000 || Math.abs(steps - value * STEPS_PER_SECOND) > 1e-6) {
    throw new PlanTextError(`${name} is ${String(field.value)}; it must be a multiple of 0.1 s, at most 3600 s`);
  }
  return steps;
}

function stretchOf(field: Field): Stretch {
  const inside = messageOf(field);
  const word = String(inside.find((f) => f.name === 'aspect')?.value ?? '');
  const aspect = Object.keys(ASPECT_NAMES).find((key) => ASPECT_NAMES[Number(key)] === word);
  if (aspect === undefined) throw new PlanTextError(`"${word}" is not an aspect; use RED, YELLOW or GREEN`);
  return { aspect: Number(aspect), steps: stepsOf(inside, 'duration_s', true) };
}
