// Reads geometry as the server sends it (tools/view/wire.h).

export interface Mesh { positions: Float32Array; normals?: Int8Array; corners?: Uint32Array }
export interface Piece { key: string; brick: [number, number, number]; vertices: number; bytes: ArrayBuffer; corners: Uint32Array }

export function readScene(data: ArrayBuffer): Mesh {
  const [vertices] = new Uint32Array(data, 0, 1);
  return { positions: new Float32Array(data, 8, vertices * 3), normals: new Int8Array(data, 8 + vertices * 12, vertices * 4) };
}

export function readMesh(data: ArrayBuffer): Mesh {
  const [vertices, triangles] = new Uint32Array(data, 0, 2);
  return { positions: new Float32Array(data, 8, vertices * 3), corners: new Uint32Array(data, 8 + vertices * 12, triangles * 3) };
}

export function readSurface(data: ArrayBuffer): { generation: number; pieces: Piece[] } {
  const [generation, count] = new Uint32Array(data, 0, 2);
  const pieces: Piece[] = [];
  for (let at = 8, i = 0; i < count; ++i) {
    const [x, y, z] = new Int32Array(data, at, 3);
    const [vertices, triangles] = new Uint32Array(data, at + 12, 2);
    at += 20;
    const bytes = data.slice(at, at + vertices * 12);
    at += vertices * 12;
    pieces.push({ key: `${x},${y},${z}`, brick: [x, y, z], vertices, bytes, corners: new Uint32Array(data, at, triangles * 3).slice() });
    at += triangles * 12;
  }
  return { generation, pieces };
}
