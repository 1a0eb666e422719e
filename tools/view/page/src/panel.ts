// The panel beside the view: it shows the state, and sends a person's changes.
import type { Rule, State } from './api';
import { faceSlide, parse, percent, show, slide, toWorld, type Length } from './lengths';

const byId = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;
const input = (id: string) => byId<HTMLInputElement>(id);

/// A text and a slider for one length. `changed` gets it, and whether the slider still moves.
export class LengthField {
  value: Length = '1%';
  private moving = false;
  constructor(private name: string, private scene: () => State['scene'], private zero: boolean, private changed: (value: Length, again: boolean) => void) {
    const text = input(name), range = input(`${name}-slide`);
    range.addEventListener('input', () => {
      const again = this.moving;
      this.moving = true;
      this.value = `${show(slide.toPercent(Number(range.value), this.zero), 2)}%`;
      text.value = String(this.value);
      text.classList.remove('wrong');
      this.changed(this.value, again);
    });
    range.addEventListener('change', () => { this.moving = false; });
    text.addEventListener('change', () => {
      const value = parse(text.value), world = toWorld(value, this.scene());
      text.classList.toggle('wrong', Number.isNaN(world));
      if (Number.isNaN(world)) return complain(`“${text.value}” is no length; write 0.5 (scene units), 2% or 20vx. It stays ${this.value}.`);
      this.set(value);
      this.changed(value, false);
    });
  }
  /// Shows the design's value, unless a person is at the field.
  follow(value: Length): void {
    if (!this.moving && document.activeElement !== input(this.name)) this.set(value);
  }
  set(value: Length): void {
    this.value = value;
    input(this.name).value = String(value);
    input(this.name).classList.remove('wrong');
    input(`${this.name}-slide`).value = String(slide.fromPercent((toWorld(value, this.scene()) / this.scene().diagonal) * 100));
  }
}

export class FaceField {
  private wait = 0;  // the timer until a moved slider counts; 0: none
  constructor(private changed: (faces: number) => void) {
    input('faces-slide').addEventListener('input', () => {
      const n = faceSlide.to(Number(input('faces-slide').value));
      input('faces').value = String(n);
      clearTimeout(this.wait);
      this.wait = window.setTimeout(() => { this.wait = 0; this.changed(n); }, 250);
    });
    input('faces').addEventListener('change', () => {
      const n = Number(input('faces').value), fine = Number.isInteger(n) && n >= 4 && n <= 1e7;
      input('faces').classList.toggle('wrong', !fine);
      if (fine) this.changed(n);
      else complain(`“${input('faces').value}” is no number of faces; write a whole number from 4 to 10000000, without commas.`);
    });
  }
  follow(n: number): void {
    if (this.wait !== 0 || document.activeElement === input('faces')) return;
    input('faces').value = String(n);
    input('faces').classList.remove('wrong');
    input('faces-slide').value = String(faceSlide.from(n));
  }
}

function placeOf(rule: Rule): string {
  if (rule.name) return rule.name;
  if (rule.node) return rule.node;
  if (rule.box) return 'box';
  if (rule.view) return 'by distance';
  if (rule.thickness !== undefined) return 'thin parts';
  if (rule.gap !== undefined) return 'openings';
  return Array.isArray(rule.at?.[0]) ? 'stroke' : 'dab';
}

let listed = '';  // the rules that are listed: the list is made anew only if they change, so that a button keeps the focus
function showRules(rules: Rule[], remove: (i: number) => void): void {
  const list = byId('rules'), text = JSON.stringify(rules);
  if (text === listed) return;
  listed = text;
  list.replaceChildren(...rules.map((rule, i) => {
    const item = document.createElement('li'), dot = document.createElement('i'), text = document.createElement('span'), button = document.createElement('button');
    dot.className = rule.mode ?? 'set';
    const words: Record<string, string> = { decrease: 'finer', increase: 'coarser', erase: 'erase', set: 'set' };
    text.textContent = `${i + 1}  ${words[rule.mode ?? 'set']} ${placeOf(rule)}${rule.scale !== undefined ? ` to ${rule.scale}` : ''}${rule.radius !== undefined ? `, radius ${rule.radius}` : ''}`;
    button.textContent = '×';
    button.title = button.ariaLabel = `Remove rule ${i + 1}`;
    button.onclick = () => remove(i);
    item.append(dot, text, button);
    return item;
  }).reverse());
}

const kProof = 'Closed, without self-intersections; every triangle of the scene lies strictly inside.';

const kVolume = 'Parts inside others count, too, in the scene’s volume. So the number may be below 1.';

function showProxy(state: State): void {
  const p = state.proxy, badge = byId('badge'), verdict = byId('verdict'), v = p.verdict;
  const working = p.step === 'meshing' || p.step === 'checking';
  const answer: string = v?.answer ?? '';
  let text = 'none', kind = '', sentence = '';
  if (p.step === 'meshing') [text, kind, sentence] = ['meshing …', 'work', ''];
  else if (p.step === 'checking') [text, kind, sentence] = ['checking …', 'work', ''];
  else if (p.step === 'failed') [text, kind, sentence] = ['failed', 'refuted', p.notes];
  else if (p.step === 'ready' && !p.current) [text, sentence] = ['of an earlier design', 'Press Mesh for the design as it is now.'];
  else if (p.step === 'ready' && answer === 'proven') [text, kind, sentence] = ['proven', 'proven', kProof];
  else if (p.step === 'ready') [text, kind, sentence] = [answer || 'no answer', 'refuted', v?.why ?? p.notes];
  badge.textContent = text;
  badge.className = `badge ${kind}`;
  verdict.textContent = sentence;
  byId('notes').textContent = p.step === 'ready' && p.current ? p.notes : '';
  const rows: [string, string, string?][] = [];
  if (v && v.levels.length > 0 && p.step === 'ready') {
    const { triangles, farthest: far, volume_ratio: ratio } = v.levels[0];
    rows.push(['triangles', triangles.toLocaleString('en')]);
    if (ratio !== null) rows.push(['volume, of the scene’s', show(ratio), kVolume]);
    if (far !== null) rows.push(['farthest from scene', `${show(far)} (${percent(far, state.scene)})`]);
    rows.push(['made, checked', `${show(p.mesh_seconds, 2)} s, ${show(p.check_seconds, 2)} s`]);
  }
  byId('measures').replaceChildren(...rows.flatMap(([name, value, hint = '']) => {
    const dt = document.createElement('dt'), dd = document.createElement('dd');
    dt.title = dd.title = hint;
    dt.textContent = name;
    dd.textContent = value;
    return [dt, dd];
  }));
  byId('mesh').textContent = working ? 'Stop' : 'Mesh';
  byId<HTMLButtonElement>('save-proxy').disabled = !(p.step === 'ready' && p.current);
  byId('save-proxy').textContent = p.saved && p.current ? 'Proxy saved' : 'Save proxy';
  byId('save-proxy').title = `Writes ${state.out_file}`;
}

export function showState(state: State, remove: (i: number) => void): void {
  const s = state.scene, c = state.closing;
  byId('title').textContent = s.files.join(', ');
  byId('title').title = s.files.join(', ');
  document.title = `${s.files[0] ?? ''} – bpview`;
  const size = s.max.map((x, i) => show(x - s.min[i])).join(' × ');
  byId('facts').textContent = byId('facts').title = `${s.triangles.toLocaleString('en')} triangles, ${size}; voxel ${show(s.voxel)}`;
  byId('base-world').textContent = `${show(state.design.base_world)} in scene units, ${show(state.design.base_world / s.voxel, 2)} voxels`;
  byId<HTMLButtonElement>('undo').disabled = !state.design.can_undo;
  byId<HTMLButtonElement>('redo').disabled = !state.design.can_redo;
  showRules(state.design.rules, remove);
  showProxy(state);
  input('live').checked = state.live;
  byId('save-rules').textContent = state.design.saved ? 'Rules saved' : 'Save rules';
  byId('save-rules').title = `Writes ${state.rules_file}`;
  byId('command').textContent = state.command;
  const behind = c.asked !== c.shown && !c.error;
  const wide = Math.round(c.drawn_voxel / s.voxel), drawn = wide > 1 ? `, drawn ${wide} times as coarse` : '';
  byId('times').textContent = c.error ? c.error : behind ? 'closing …' : `closing ${Math.round(c.seconds * 1000)} ms, ${c.voxels.toLocaleString('en')} voxels${drawn}`;
  byId('times').title = drawn ? 'The surface has more faces than a page draws; the closing and the proxy have all voxels' : '';
  byId('legend').hidden = state.design.rules.length === 0;
  byId('legend-low').textContent = `${percent(state.design.base_world / 8, s)}`;
  byId('legend-high').textContent = `${percent(state.design.base_world * 8, s)}`;
}

let standing = '', timer = 0;  // a message that stays; the timer of one that goes
function showMessage(text: string): void {
  byId('message-text').textContent = text;
  byId('message').hidden = text === '';
}
/// Shows a message for some seconds, or until it is withdrawn.
export function complain(error: unknown, stays = false): void {
  const text = error instanceof Error ? error.message : String(error);
  if (stays) standing = text;
  showMessage(text);
  clearTimeout(timer);
  timer = stays ? 0 : window.setTimeout(() => { timer = 0; showMessage(standing); }, 6000);
}
/// Withdraws the message that stays.
export function withdraw(): void {
  standing = '';
  if (timer === 0) showMessage('');
}
