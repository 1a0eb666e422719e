// The page of bpview (docs/bpview.1.md).
import { bytes, enter, listen, post, state as askState, type State, type Vec3 } from './api';
import { Brush, type Tool } from './brush';
import { percent, show, toWorld } from './lengths';
import { Plot, type PlotPoint } from './plot';
import { Ruler } from './ruler';
import { complain, FaceField, LengthField, showState, withdraw } from './panel';
import { View, type Layer } from './view';
import { Cut } from './cut';
import { Files, isProvable } from './files';
import { Frames } from './frames';
import { kFaces, type Faces } from './shown';
import { Kept } from './kept';
import { Mirror } from './mirror';
import { onClick } from './clicks';
import { Parts } from './parts';
import { readMesh, readSurface } from './wire';

// A new link in this tab changes the part behind # only.
addEventListener('hashchange', () => { if (location.hash.length > 1) location.reload(); });

const byId = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;
let state: State;
const shown: Record<Layer, boolean> = { scene: false, closing: true, proxy: false };
/// State that the tests wait for and read.
const told = { generation: 0, proxy: 0, revision: 0, ready: false, state: () => state, settled: () => isSettled(), kept: () => kept.revision, files: () => files.told.loaded, frames: () => view.frames, frame: () => frames.place(), pixel: (p: Vec3) => view.pixelOf(view.fromScene(p)) };
(window as any).bpview = told;

function makeView(): View {
  try { return new View(byId('canvas')); } catch (error) {
    complain('This browser draws no WebGL 2, which the page needs; switch it on, or open the link in another browser.', true);
    throw error;
  }
}
const view = makeView();

/// Edits reach the server in the order in which they were made.
let queue: Promise<unknown> = Promise.resolve();
let onTheWay = 0, answered = 0;  // requests without an answer; the design's revision after the last one that has one
/// Returns whether the server has done it.
function send(path: string, body: unknown = {}): Promise<boolean> {
  sendWaiting();
  ++onTheWay;
  const sent = queue.then(() => post(path, body)).then((revision) => { answered = Math.max(answered, revision); return true; })
    .catch((error) => { complain(error); return false; }).finally(() => { --onTheWay; settle(); });
  queue = sent;
  return sent;
}
/// The state lags behind while edits are on the way: what depends on the design waits until it has all of them.
const isSettled = () => onTheWay === 0 && waiting === null && state.design.revision >= answered;
const later: (() => void)[] = [];
function settle(): void {
  if (!isSettled()) return;
  base.follow(state.design.base);
  faces.follow(state.faces);
  frames.tell(state.design.orientation);
  while (later.length > 0 && isSettled()) later.shift()!();
}
/// Runs one task at a time. If tasks follow quickly, only the last one waits; it replaces those before.
let waiting: (() => void) | null = null;
function sendLast(body: unknown): void {
  const idle = waiting === null;
  waiting = () => { void send('/api/edit', body); };
  if (!idle) return;
  void queue.then(() => setTimeout(sendWaiting, 30));
}
function sendWaiting(): void {
  const next = waiting;
  waiting = null;
  next?.();
}

const facts = () => state.scene;
const base = new LengthField('base', facts, false, (value, again) => sendLast({ op: 'base', base: value, again }));
const target = new LengthField('target', facts, false, (value, again) => {
  brush.target = value;
  if (!again && (brush.tool === 'decrease' || brush.tool === 'increase')) checkTarget(brush.tool);
});
const radius = new LengthField('radius', facts, false, (value) => { brush.radius = value; });
const faces = new FaceField((n) => { void send('/api/edit', { op: 'faces', faces: n }); });
let hovered: Vec3 | null = null;  // the point of the surface under the pointer
const brush: Brush = new Brush(byId('canvas'), view, facts,
  (rule, again) => (again ? sendLast : (body: unknown) => void send('/api/edit', body))({ op: 'rule', rule, again }),
  (rule) => mirror.both(rule),
  (at: Vec3 | null) => { hovered = at; byId('point').textContent = at ? at.map((x) => show(x, 5)).join('  ') : ''; });

const files = new Files(byId('files'), byId('proofs'), view, (i) => void send('/api/check', { file: i }), () => { showDistances(); showPlot(); });
const ruler = new Ruler(byId('canvas'), view, facts, byId('ruler-label'), byId('ruler'));

const kept = new Kept(byId('kept'));

let cut: Cut;
let mirror: Mirror;
const frames = new Frames(view, byId('canvas'), facts, (value, again) => (again ? sendLast : (body: unknown) => void send('/api/edit', body))({ op: 'orientation', orientation: value, again }));
/// A frame is placed under the pointer, else under the middle of the view, else in the middle of the scene.
function addFrame(): void {
  const canvas = byId('canvas'), seen = hovered ? null : view.pick(canvas.clientWidth / 2, canvas.clientHeight / 2);
  const at = hovered ?? (seen ? view.toScene(seen) : state.scene.middle);
  later.push(() => frames.add(at));
  settle();
}

/// The proxy that is shown: one that was made before, or 0, the last one.
let chosen = 0;
const plot = new Plot(byId('plot'));
function chooseProxy(number: number): void {
  chosen = number === state.proxy.number ? 0 : number;
  told.proxy = 0;
  shown.proxy = true;
  files.showOnly(-1);
  showLayers();
  void follow().then(showPlot);
}
function showPlot(): void {
  const now = chosen || state.proxy.number;
  const made = state.made.map((p): PlotPoint => ({ name: `proxy ${p.number}, ${p.answer}`, faces: p.triangles, error: p.farthest, volume: p.volume_ratio, color: '#3f9d74',
    current: shown.proxy && p.number === now, act: () => chooseProxy(p.number) }));
  const levels = state.layers.flatMap((layer, i) => (layer.verdict?.levels ?? []).flatMap((level, n): PlotPoint[] => (level.answer !== 'proven' ? [] : [{
    name: layer.levels > 1 ? `${layer.name}, level ${n}` : layer.name, faces: level.triangles, error: level.farthest, volume: level.volume_ratio, color: files.color(i),
    current: files.isShown(i, n), act: () => { shown.proxy = false; files.showOnly(i, n); showLayers(); } }])));
  plot.tell([...made, ...levels], state.scene);
}

/// The legend of the distances from the scene.
let distances = false;
function showDistances(): void {
  const farthest = view.colorByDistance(distances);
  byId('far').hidden = !(distances && farthest > 0);
  byId('far-high').textContent = farthest > 0 ? `${show(farthest)} (${show(farthest / state.scene.voxel, 2)} voxels, ${percent(farthest, state.scene)})` : '';
}
async function turnDistances(on: boolean): Promise<void> {
  distances = on;
  byId<HTMLInputElement>('distances').checked = on;
  told.proxy = 0;
  await Promise.all([files.showDistances(on), follow()]);
  showDistances();
}

let look: Faces = 'edges';
function lookAs(next: Faces): void {
  look = next;
  view.setFaces(look);
  for (const button of document.querySelectorAll<HTMLButtonElement>('[data-faces]')) button.ariaPressed = String(button.dataset.faces === look);
}

/// The panel has two halves: what a person designs, and what he looks at.
function turnTo(half: string): void {
  for (const button of document.querySelectorAll<HTMLButtonElement>('[data-half]')) button.ariaSelected = String(button.dataset.half === half);
  for (const name of ['design', 'look']) byId(name).hidden = name !== half;
  byId('save').hidden = half !== 'design';
}

function showLayers(): void {
  for (const slider of document.querySelectorAll<HTMLInputElement>('[data-opacity]')) {
    const layer = slider.dataset.opacity as Layer;
    view.style(layer, shown[layer], Number(slider.value) / 100);
    slider.disabled = !shown[layer];
  }
  showDistances();
  showPlot();
  for (const button of document.querySelectorAll<HTMLButtonElement>('[data-layer]'))
    button.ariaPressed = String(shown[button.dataset.layer as Layer]);
}
function toggle(layer: Layer): void {
  shown[layer] = !shown[layer];
  showLayers();
}
/// Says it if the scale of the brush would change nothing: only a scale below that of a place is finer.
function checkTarget(mode: 'decrease' | 'increase'): void {
  if (!state) return;
  const its = toWorld(brush.target, state.scene), everywhere = state.design.base_world;
  if (mode === 'increase' && its <= everywhere) complain(`Its scale, ${brush.target}, is not above ${state.design.base}, the scale everywhere: raise it, and places become coarser.`);
  if (mode === 'decrease' && its >= everywhere) complain(`Its scale, ${brush.target}, is not below ${state.design.base}, the scale everywhere: lower it, and places become finer.`);
}
function choose(tool: Tool): void {
  brush.tool = tool;
  if (tool === 'decrease' || tool === 'increase') checkTarget(tool);
  byId('canvas').classList.toggle('brush', tool !== 'turn');
  ruler.active = tool === 'ruler';
  frames.activate(tool === 'turn');
  byId('cross').hidden = tool !== 'ruler' && tool !== 'part';
  if (tool !== 'ruler') ruler.clear();
  const hints: Record<Tool, string> = { ruler: 'click two points · Enter: the point under the cross', part: 'click on a part · Enter: the part under the cross', turn: 'drag: turn · right drag: move · wheel: zoom', decrease: 'drag on the surface: finer · Alt: turn',
    increase: 'drag on the surface: coarser · Alt: turn', erase: 'drag on the surface: base scale · Alt: turn' };
  byId('hint').textContent = hints[tool];
  for (const button of document.querySelectorAll<HTMLButtonElement>('[data-tool]')) button.ariaPressed = String(button.dataset.tool === tool);
  if (!brush.paints) view.setBrush(null, 0, '#000');
}
function size(by: number): void {
  const now = Number(byId<HTMLInputElement>('radius-slide').value);
  byId<HTMLInputElement>('radius-slide').value = String(now + by);
  byId('radius-slide').dispatchEvent(new Event('input'));
  byId('radius-slide').dispatchEvent(new Event('change'));
}
const isBusy = () => state.proxy.step === 'meshing' || state.proxy.step === 'checking';
const edit = (op: string) => void send('/api/edit', { op });

for (const button of document.querySelectorAll<HTMLButtonElement>('[data-layer]')) button.onclick = () => toggle(button.dataset.layer as Layer);
for (const slider of document.querySelectorAll<HTMLInputElement>('[data-opacity]')) slider.oninput = showLayers;
for (const button of document.querySelectorAll<HTMLButtonElement>('[data-tool]')) button.onclick = () => choose(button.dataset.tool as Tool);
for (const button of document.querySelectorAll<HTMLButtonElement>('[data-faces]')) button.onclick = () => lookAs(button.dataset.faces as Faces);
for (const button of document.querySelectorAll<HTMLButtonElement>('[data-half]')) button.onclick = () => turnTo(button.dataset.half!);
byId('undo').onclick = () => edit('undo');
byId('redo').onclick = () => edit('redo');
byId('mesh').onclick = () => void send(isBusy() ? '/api/stop' : '/api/mesh');
byId('save-rules').onclick = () => void send('/api/save', { what: 'rules' });
byId('save-proxy').onclick = () => void send('/api/save', { what: 'proxy' });
byId<HTMLInputElement>('live').onchange = (event) => void send('/api/edit', { op: 'live', live: (event.target as HTMLInputElement).checked });
byId<HTMLInputElement>('distances').onchange = (event) => void turnDistances((event.target as HTMLInputElement).checked);
/// A rule by name has the scale of the brush. A name that no part has is refused by the server.
const parts = new Parts(byId('part-row'), byId<HTMLInputElement>('part'), byId('part-names'), byId('part-finer'), byId('part-coarser'), (node, mode) =>
  void send('/api/edit', { op: 'rule', rule: { node, scale: brush.target, mode } }).then((done) => { if (done) checkTarget(mode); }));
function takePart(x: number, y: number): void {
  const at = view.pick(x, y);
  void parts.take(at && view.toScene(at));
}
onClick(byId('canvas'), () => brush.tool === 'part', takePart);
byId('prove-all').onclick = () => state.layers.forEach((layer, i) => { if (isProvable(layer)) void send('/api/check', { file: i }); });
for (const button of document.querySelectorAll<HTMLButtonElement>('[data-cubes]'))
  button.onclick = () => (button.dataset.cubes === 'frame' ? addFrame() : frames.choose(button.dataset.cubes === 'auto' ? 'auto' : null));
byId('copy').onclick = async () => {
  await navigator.clipboard.writeText(state.command).catch(complain);
  byId('copy').textContent = 'Copied';
  setTimeout(() => { byId('copy').textContent = 'Copy'; }, 1500);
};

addEventListener('keydown', (event) => {
  if (event.target instanceof HTMLInputElement && event.target.type !== 'range' && event.target.type !== 'checkbox') {
    if (event.key === 'Enter' || event.key === 'Escape') byId('view').focus();  // keys are commands again
    return;
  }
  const key = event.key.toLowerCase();
  if (event.ctrlKey || event.metaKey) {
    if (key === 'z') edit(event.shiftKey ? 'redo' : 'undo');
    else if (key === 'y') edit('redo');
    else return;
    event.preventDefault();
    return;
  }
  if (event.altKey) return;
  // Arrows turn the view, or move it with Shift; sliders and lists keep theirs.
  const arrows: Record<string, [number, number]> = { arrowleft: [-1, 0], arrowright: [1, 0], arrowup: [0, 1], arrowdown: [0, -1] };
  if (event.target === document.body || event.target === byId('view')) {
    const [right, up] = arrows[key] ?? [0, 0];
    if (right || up) {
      if (event.shiftKey) view.pan(right * 0.02, up * 0.02);
      else view.turn(right * 0.09, up * 0.09);
      return event.preventDefault();
    }
    if (key === 'enter' && ruler.active) return ruler.takeMiddle();
    if (key === 'enter' && brush.tool === 'part') return takePart(byId('canvas').clientWidth / 2, byId('canvas').clientHeight / 2);
  }
  const acts: Record<string, () => void> = {
    1: () => toggle('scene'), 2: () => toggle('closing'), 3: () => toggle('proxy'), f: () => view.frame(), '[': () => size(-40), ']': () => size(40),
    '+': () => view.zoom(0.9), '=': () => view.zoom(0.9), '-': () => view.zoom(1 / 0.9),
    v: () => choose('turn'), escape: () => choose('turn'), b: () => choose('decrease'), c: () => choose('increase'), e: () => choose('erase'),
    m: () => byId('mesh').click(), r: () => choose('ruler'), p: () => { if (!byId('part-row').hidden) choose('part'); }, y: () => mirror.next(), o: addFrame, d: () => void turnDistances(!distances), g: () => lookAs(kFaces[(kFaces.indexOf(look) + 1) % kFaces.length]), l: () => turnTo(byId('look').hidden ? 'look' : 'design'),
    x: () => cut.next(), ',': () => cut.move(-10), '.': () => cut.move(10), '<': () => cut.move(-1), '>': () => cut.move(1), '\\': () => cut.flip(), k: () => cut.toggleFill(),
  };
  if (key >= '4' && key <= '9') files.toggle(Number(key) - 4);
  else acts[key]?.();
});

/// Fetches geometry that is newer than what is shown, one request at a time.
let fetching = false;
async function follow(): Promise<void> {
  if (fetching) return;
  fetching = true;
  try {
    while (told.generation !== state.closing.generation || told.proxy !== (chosen || state.proxy.number)) {
      if (told.generation !== state.closing.generation) {
        const surface = readSurface(await bytes(`/api/surface?after=${told.generation}`));
        view.setSurface(surface);
        told.generation = surface.generation;
      }
      if (told.proxy !== (chosen || state.proxy.number)) {
        const number = chosen || state.proxy.number, asked = distances, query = `/api/proxy?number=${chosen}&distances=${Number(distances)}`;
        const data = await bytes(query).catch((error) => { complain(error); return new ArrayBuffer(0); });  // it may be too large to draw
        view.setProxy(data.byteLength ? readMesh(data) : null);
        if (asked !== distances || number !== (chosen || state.proxy.number)) continue;  // they were switched meanwhile
        told.proxy = number;
        showDistances();
      }
    }
    told.revision = state.closing.shown;
  } catch (error) {
    complain(error);
  }
  fetching = false;
}

function tell(next: State): void {
  if (next.proxy.number !== state.proxy.number) chosen = 0;  // a new proxy is shown at once
  state = next;
  showState(state, (i) => void send('/api/edit', { op: 'remove', rule: i }));
  files.tell(state.layers);
  settle();
  void kept.follow(() => state);
  showPlot();
  view.setBase(state.design.base_world);
  void follow();
}

async function begin(): Promise<void> {
  await enter();
  state = await askState();
  view.begin(state);
  base.set(state.design.base);
  target.set('0.5%');
  radius.set('3%');
  [brush.target, brush.radius] = ['0.5%', '3%'];
  cut = new Cut(view, byId('cut'), byId('cut-place'), [...document.querySelectorAll<HTMLButtonElement>('[data-cut]')], byId('cut-flip'), byId('cut-fill'));
  mirror = new Mirror(view, facts, byId('mirror-at'), [...document.querySelectorAll<HTMLButtonElement>('[data-mirror]')]);
  byId('cubes').hidden = state.element !== 'cube';
  files.tell(state.layers);  // the plot needs its rows
  choose('turn');
  lookAs(look);
  turnTo(state.layers.length > 0 ? 'look' : 'design');
  showLayers();
  tell(state);
  listen(tell, (message) => { kept.offer(state); complain(message, true); }, () => { kept.withdraw(); withdraw(); });
  if (state.scene.shown) view.setScene(readMesh(await bytes('/api/scene')));
  else {
    const button = byId('layers').querySelector<HTMLButtonElement>('[data-layer=scene]')!;
    button.disabled = true;
    button.title = `More than ${state.scene.most_shown.toLocaleString('en')} triangles: the scene is not drawn`;
  }
  await parts.begin();
  told.ready = true;
}
begin().catch((error) => complain(error, true));
