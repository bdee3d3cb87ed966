import {
  arrivedAt,
  asked,
  directed,
  directiveIn,
  fieldsAt,
  fieldsOf,
  refusedWith,
  spread,
  wanted,
} from '@page/lib/run/fields';

const PATH = 'traffic.west.flow_veh_per_h';
const live = () =>
  fieldsOf([
    {
      $typeName: 'lukou.console.LiveField',
      path: PATH,
      unit: 'veh/h',
      value: '1800',
      initial: '1800',
      min: 0,
      max: 10800,
      source: '',
      words: [],
    },
  ]);

describe('a field that may change while the run goes on', () => {
  it('holds its old value until the step from which the new one acts', () => {
    const field = asked(live(), PATH, '600');
    expect(field.get(PATH)).toMatchObject({ value: '1800', asked: '600', coming: null });
    const accepted = directed(field, `${PATH}=600`, 121, 100);
    expect(accepted.get(PATH)).toMatchObject({ value: '1800', asked: null, coming: { value: '600', step: 121 } });
    expect(arrivedAt(accepted, 120).get(PATH)).toMatchObject({ value: '1800' });
    expect(arrivedAt(accepted, 121).get(PATH)).toMatchObject({ value: '600', coming: null, asked: null });
  });

  it('has the value at once if its step is over', () => {
    expect(directed(live(), `${PATH}=600`, 50, 100).get(PATH)).toMatchObject({
      value: '600',
      coming: null,
      asked: null,
    });
  });

  it('says why it was refused until it is asked again', () => {
    const refused = refusedWith(asked(live(), PATH, '99999'), PATH, 'must be within [0, 10800]');
    expect(refused.get(PATH)).toMatchObject({ value: '1800', asked: null, refusal: 'must be within [0, 10800]' });
    expect(asked(refused, PATH, '5').get(PATH)?.refusal).toBe('');
  });

  it('keeps what was accepted before when a later value is refused', () => {
    const accepted = directed(live(), `${PATH}=600`, 121, 100);
    const refused = refusedWith(asked(accepted, PATH, '99999'), PATH, 'must be within [0, 10800]');
    expect(wanted(refused.get(PATH)!)).toBe('600');
    expect(arrivedAt(refused, 121).get(PATH)?.value).toBe('600');
  });

  it('leaves directives of other fields and other words alone', () => {
    expect(directed(live(), 'run.seed=5', 1, 0).size).toBe(1);
    expect(directiveIn('paused')).toBeNull();
    expect(directiveIn('signals.plan={cycle_s: 90}')).toEqual({ path: 'signals.plan', value: '{cycle_s: 90}' });
  });

  it('of a recording has the value of the step that is shown, whichever way time went', () => {
    const live = [
      {
        $typeName: 'lukou.console.LiveField' as const,
        path: PATH,
        unit: 'veh/h',
        value: '300', // in the end
        initial: '1800',
        source: '',
        words: [],
      },
    ];
    const changes = [
      { step: 200, text: `${PATH}=900` },
      { step: 5000, text: `${PATH}=300` },
    ];
    const values = [100, 6000, 300, 0].map((step) => fieldsAt(live, changes, step).get(PATH)?.value);
    expect(values).toEqual(['1800', '300', '900', '1800']);
  });
});

describe('all flows together', () => {
  const flows = (...values: string[]) =>
    fieldsOf(
      values.map((value, i) => ({
        $typeName: 'lukou.console.LiveField',
        path: `flow${i}`,
        unit: '',
        value,
        initial: value,
        max: 10800,
        source: '',
        words: [],
      })),
    );
  const values = (...args: Parameters<typeof spread>) => spread(...args).map(({ value }) => value);

  it('are alike, or keep their proportions', () => {
    const fields = [...flows('2000', '700').values()];
    expect(values(fields, 900, true)).toEqual(['900', '900']);
    expect(values(fields, 2700, false)).toEqual(['4000', '1400']);
  });

  it('are alike when there is nothing to keep, and stay within their range', () => {
    expect(values([...flows('0', '0').values()], 500, false)).toEqual(['500', '500']);
    expect(values([...flows('10000', '2000').values()], 9000, false)).toEqual(['10800', '3000']);
  });
});
