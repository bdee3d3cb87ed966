import { directed, fieldsOf, type Fields } from '@page/lib/run/fields';
import { pushed, restoring, standing } from '@page/lib/run/undo';

const WEST = 'traffic.west.flow_veh_per_h';

const fields = (): Fields =>
  fieldsOf(
    [
      [WEST, '1800'],
      ['signals.preset', 'PAPER'],
      ['signals.plan', ''],
      ['radio.downlink.latency.constant_ms', ''],
    ].map(([path, value]) => ({
      $typeName: 'lukou.console.LiveField',
      path,
      unit: '',
      value,
      initial: value,
      source: '',
      words: [],
    })),
  );

describe('taking a change back', () => {
  it('means the value before, also one that is still on its way', () => {
    expect(restoring(fields(), WEST)).toEqual({ path: WEST, value: '1800' });
    expect(restoring(directed(fields(), `${WEST}=600`, 50, 10), WEST)).toEqual({ path: WEST, value: '600' });
  });

  it('of a plan means the preset, if that ran before, and the other way round', () => {
    expect(restoring(fields(), 'signals.plan')).toEqual({ path: 'signals.preset', value: 'PAPER' });
    const planned = directed(fields(), 'signals.plan={cycle_s: 90}', 50, 10);
    expect(restoring(planned, 'signals.preset')).toEqual({ path: 'signals.plan', value: '{cycle_s: 90}' });
    const again = directed(planned, 'signals.preset=PAPER_YELLOW', 60, 20);
    expect(restoring(again, 'signals.plan')).toEqual({ path: 'signals.preset', value: 'PAPER_YELLOW' });
  });

  it('is nothing where there was no value', () => {
    expect(restoring(fields(), 'radio.downlink.latency.constant_ms')).toBeNull();
    expect(restoring(fields(), 'no.such.field')).toBeNull();
  });

  it('leaves alone what somebody else has changed since', () => {
    const mine = [{ path: WEST, set: '600', before: { path: WEST, value: '1800' } }];
    expect(standing(mine, directed(fields(), `${WEST}=600`, 5, 10))).toEqual(mine);
    expect(standing(mine, directed(fields(), `${WEST}=700`, 5, 10))).toEqual([]);
  });

  it('goes back fifty times, and never over nothing', () => {
    const one = [{ path: WEST, set: '1', before: { path: WEST, value: '0' } }];
    let kept: ReturnType<typeof pushed> = [];
    for (let i = 0; i < 60; ++i) kept = pushed(kept, one);
    expect(kept).toHaveLength(50);
    expect(pushed([], [])).toEqual([]);
  });
});
