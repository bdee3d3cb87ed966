import { equal, setBehind, type Plan } from '@page/lib/plan/plan';
import { parseText } from '@page/lib/plan/text_format';
import { planFile, planFromText, planValue, secondsText } from '@page/lib/plan/textproto';

function plan(): Plan {
  const lane = [
    { aspect: 3, steps: 425 },
    { aspect: 2, steps: 30 },
    { aspect: 1, steps: 445 },
  ];
  return setBehind({ cycle: 900, offset: 15, lanes: Array(12).fill(lane) }, [3, 4], 0, 1);
}

describe('a plan as text', () => {
  it('comes back as it was, from the file and from the value of a request', () => {
    expect(equal(planFromText(planFile(plan())), plan())).toBe(true);
    expect(equal(planFromText(planValue(plan())), plan())).toBe(true);
  });

  it('is one line for a request, with lanes of one kind together', () => {
    const value = planValue(plan());
    expect(value).not.toContain('\n');
    expect(value.match(/lane_plans/g)).toHaveLength(2);
    expect(value).toContain('lanes: "SL" lanes: "SC" aspects { aspect: RED duration_s: 90 }');
    expect(value).toContain('offset_s: 1.5');
  });

  it('is read from a whole scenario with comments, lists and other brackets', () => {
    const text = `run { seed: 7 } # the seed
      signals < plan { cycle_s: 60, offset_s: 0
        lane_plans { lanes: ["WL", 'WC', "WR", "SL", "SC", "SR", "EL", "EC", "ER", "NL", "NC", "NR"]
          aspects { aspect: GREEN duration_s: 30 }; aspects: { aspect: RED duration_s: 30.0 } } } >`;
    const read = planFromText(text);
    expect(read.cycle).toBe(600);
    expect(read.lanes[11]).toEqual([
      { aspect: 3, steps: 300 },
      { aspect: 1, steps: 300 },
    ]);
  });

  it.each([
    ['cycle_s: 90 lane_plans { lanes: "XX" aspects { aspect: RED duration_s: 90 } }', 'XX'],
    ['cycle_s: 90 lane_plans { lanes: "WL" lanes: "WL" aspects { aspect: RED duration_s: 90 } }', 'twice'],
    ['cycle_s: 90 lane_plans { lanes: "WL" aspects { aspect: RED duration_s: 80 } }', 'WL adds up to 80 s'],
    ['cycle_s: 90 lane_plans { lanes: "WL" aspects { aspect: BLUE duration_s: 90 } }', 'BLUE'],
    ['cycle_s: 90.05', 'multiple of 0.1 s'],
    ['lane_plans { }', 'cycle_s is missing'],
    ['cycle_s: 90 lane_plans {', 'at the end'],
    ['cycle_s 90', 'expected :'],
    ['cycle_s: 90\n  offset_s: %', 'line 2'],
  ])('refuses %s and says why', (text, why) => {
    expect(() => planFromText(text)).toThrow(why);
  });

  it('writes tenths of seconds only where there are some', () => {
    expect([secondsText(450), secondsText(425), secondsText(0)]).toEqual(['45', '42.5', '0']);
  });

  it('reads nested messages, lists of messages and escaped texts', () => {
    expect(parseText('a { b: "x\\"y" } c: [{d: 1}, {d: 2}]')).toEqual([
      { name: 'a', value: [{ name: 'b', value: 'x"y' }] },
      { name: 'c', value: [{ name: 'd', value: '1' }] },
      { name: 'c', value: [{ name: 'd', value: '2' }] },
    ]);
  });
});
