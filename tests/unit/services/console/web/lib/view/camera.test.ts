import { Camera, FARTHEST, NEAREST } from '@page/lib/view/camera';

const camera = () => {
  const made = new Camera();
  made.size = { width: 800, height: 400 };
  made.fit(50);
  return made;
};

describe('the camera', () => {
  it('fits a reach into the shorter side', () => {
    expect(camera().scale).toBe(4); // 400 px for 2 x 50 m
    expect([camera().toScreenX(0), camera().toScreenY(0)]).toEqual([400, 200]);
    expect(camera().toScreenY(50)).toBe(0); // north is up
  });

  it('keeps the place under the pointer while it zooms', () => {
    const zoomed = camera();
    const before = zoomed.toPlane(600, 100);
    zoomed.zoomAt(600, 100, 2.5);
    const after = zoomed.toPlane(600, 100);
    expect(after.xM).toBeCloseTo(before.xM, 9);
    expect(after.yM).toBeCloseTo(before.yM, 9);
    expect(zoomed.scale).toBe(10);
  });

  it('zooms within bounds', () => {
    const zoomed = camera();
    zoomed.zoomAt(0, 0, 1e6);
    expect(zoomed.scale).toBe(NEAREST);
    zoomed.zoomAt(0, 0, 1e-9);
    expect(zoomed.scale).toBe(FARTHEST);
  });

  it('moves with the hand', () => {
    const moved = camera();
    moved.panBy(40, 20);
    expect([moved.toScreenX(0), moved.toScreenY(0)]).toEqual([440, 220]);
  });
});
