// Clicks on the canvas: a drag turns the view, and is none.
const kStill = 4;  // pixels

/// Calls `take` with the pixel of the canvas, for each click while `active` holds.
export function onClick(canvas: HTMLCanvasElement, active: () => boolean, take: (x: number, y: number) => void): void {
  let down: [number, number] | null = null;
  canvas.addEventListener('pointerdown', (event) => { down = active() && event.button === 0 ? [event.clientX, event.clientY] : null; });
  canvas.addEventListener('pointerup', (event) => {
    if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > kStill) return;
    const box = canvas.getBoundingClientRect();
    take(event.clientX - box.left, event.clientY - box.top);
  });
}
