import { addressOf, linkOf, sightIn, type Sight } from '@page/lib/view/link';

const sight: Sight = {
  tab: 'signals',
  colouring: 'speed',
  radio: true,
  section: { reachM: 34.5, centre: { xM: 12, yM: -40.5 } },
  car: 1136,
  follow: false,
  lane: 4,
  language: 'zh',
  theme: 'dark',
};

describe('a link to a view', () => {
  it('says all that is looked at, and is read back the same', () => {
    const link = linkOf(sight);
    expect(link).toBe(
      '#panel=signals&colour=speed&radio&reach=34.5&centre=12,-40.5&car=1136&lane=SC&lang=zh&theme=dark',
    );
    const { follow, ...rest } = sight;
    expect(follow).toBe(false);
    expect(sightIn(link)).toEqual(rest);
  });

  it('has no middle while a car is followed, since that moves', () => {
    const link = linkOf({ ...sight, follow: true });
    expect(link).not.toContain('centre');
    expect(sightIn(link)).toMatchObject({ car: 1136, follow: true, section: { reachM: 34.5, centre: null } });
  });

  it('follows nobody without a car', () => {
    expect(linkOf({ ...sight, car: null, follow: true })).not.toContain('follow');
    expect(sightIn('#follow').follow).toBeUndefined();
  });

  it('that is mistyped says what it can', () => {
    expect(sightIn('#panel=nowhere&colour=speed&reach=-4&car=x&lane=XX&lang=fr&centre=1,2')).toEqual({
      colouring: 'speed',
    });
    expect(sightIn('#reach=50&centre=1,nonsense').section).toEqual({ reachM: 50, centre: null });
    expect(sightIn('')).toEqual({});
    expect(sightIn('#%%%&&==')).toEqual({});
  });

  it('does not hand the token on', () => {
    expect(addressOf('http://h:8080/?token=0123456789abcdef&x=1', '#panel=log')).toBe('http://h:8080/?x=1#panel=log');
  });
});
