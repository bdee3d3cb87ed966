import { arrivedAt, asked, directed, directiveIn, fieldsOf, refusedWith, wanted } from '@page/lib/run/fields';

const PATH = 'traffic.west.flow_veh_per_h';
const live = () =>
  fieldsOf([
    {
      $typeName: 'lukou.console.LiveField',
      path: PATH,
      unit: 'veh/h',
      value: '1800',
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
});
