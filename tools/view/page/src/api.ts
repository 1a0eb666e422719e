// Requests to the server and its answers (tools/view/session.h).

export type Vec3 = [number, number, number];
export interface Rule {
  at?: Vec3 | Vec3[]; box?: Vec3[]; node?: string; view?: unknown; thickness?: unknown; gap?: unknown;
  name?: string; radius?: number | string; support?: number | string; scale?: number | string; mode?: string;
}
/// A frame is a quaternion w, x, y, z, or two axes.
export interface Frame { at: Vec3; frame: number[] | Vec3[] }
export type Orientation = null | 'auto' | Frame[];
export interface Measures { answer: string; triangles: number; volume: number | null; volume_ratio: number | null; farthest: number | null }
export interface Verdict { answer: string; why: string | null; levels: Measures[] }
export interface MadeProxy extends Measures { number: number; revision: number; faces: number }
export interface LayerState {
  name: string; kind: 'mesh' | 'tileset' | 'voxels'; levels: number; contract: string; claims: string; not_claimed: string; made_by: string[];
  step: 'none' | 'waiting' | 'checking' | 'done' | 'failed'; verdict: Verdict | null; notes: string;
}
export interface State {
  scene: { files: string[]; triangles: number; shown: boolean; most_shown: number; min: Vec3; max: Vec3; diagonal: number; middle: Vec3; voxel: number; origin: Vec3; up: string };
  design: { revision: number; base: number | string; base_world: number; rules: Rule[]; orientation: Orientation; can_undo: boolean; can_redo: boolean; saved: boolean };
  closing: { asked: number; shown: number; generation: number; drawn_voxel: number; voxels: number; seconds: number; error: string };
  element: 'cube' | 'ball';
  layers: LayerState[];
  made: MadeProxy[];
  proxy: { step: 'none' | 'meshing' | 'checking' | 'ready' | 'failed' | 'stopped'; current: boolean; faces: number; number: number; bytes: number; saved: boolean;
    mesh_seconds: number; check_seconds: number; notes: string; verdict: Verdict | null };
  faces: number; live: boolean; rules_file: string; out_file: string; command: string;
}

export const kGone = 'bpview does not answer; is it still running?';

async function ask(path: string, more: RequestInit = {}): Promise<Response> {
  const response = await fetch(path, more).catch(() => { throw new Error(kGone); });
  if (response.ok) return response;
  const text = await response.text();
  let message = text;
  try { message = JSON.parse(text).error; } catch { /* not by the server itself */ }
  throw new Error(message || `the server answered ${response.status}`);
}

/// Sends the token of the link once, and removes it from the address.
export async function enter(): Promise<void> {
  const token = location.hash.slice(1);
  if (!token) return;
  await ask('/session', { method: 'POST', body: token });
  history.replaceState(null, '', '/');
}

export async function bytes(path: string): Promise<ArrayBuffer> {
  return (await ask(path)).arrayBuffer();
}

/// Sends a request. Returns the design's revision after it, and 0 if the request does not change the design.
export async function post(path: string, body: unknown = {}): Promise<number> {
  const answer = await (await ask(path, { method: 'POST', body: JSON.stringify(body) })).json();
  return answer.revision ?? 0;
}

/// Names of the scene's parts, for rules by name.
export async function parts(): Promise<string[]> {
  return (await ask('/api/parts')).json();
}

/// The name of the part of the scene that is nearest to a point; empty: it has none.
export async function partAt(at: Vec3): Promise<string> {
  return (await (await ask(`/api/part?x=${at[0]}&y=${at[1]}&z=${at[2]}`)).json()).part;
}

/// The file of rules that the server would save.
export async function rules(): Promise<string> {
  return (await ask('/api/rules')).text();
}

export async function state(): Promise<State> {
  return (await ask('/api/state')).json();
}

/// Calls `tell` with each state, `lost` with a message while the server does not answer, and `back` when it answers again.
export function listen(tell: (state: State) => void, lost: (message: string) => void, back: () => void): void {
  const events = new EventSource('/api/events');
  events.onmessage = (event) => tell(JSON.parse(event.data));
  events.onopen = back;
  // A server that refuses the cookie is another one at the same port.
  events.onerror = () => lost(events.readyState === EventSource.CLOSED ? 'bpview was started anew; open the link that it printed.' : kGone);
}
