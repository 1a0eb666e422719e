// Reads geometry as the server sends it (tools/view/geometry/wire.h, tools/view/geometry/shown_mesh.h).

export interface Mesh { positions: Float32Array; normals: Int8Array | null; corners: Uint32Array | null; edges: Uint32Array | null; distances: Float32Array | null; faces: number }
export interface Piece { key: string; brick: [number, number, number]; vertices: number; bytes: ArrayBuffer; corners: Uint32Array }

export function readMesh(data: ArrayBuffer): Mesh {
  const [positions, normals, triangles, edges, distances, faces] = new Uint32Array(data, 0, 6);
  let at = 24;
  const next = <T>(bytes: number, make: () => T): T => { const made = make(); at += bytes; return made; };
  return {
    positions: next(positions * 12, () => new Float32Array(data, at, positions * 3)),
    normals: next(normals * 4, () => (normals ? new Int8Array(data, at, normals * 4) : null)),
    corners: next(triangles * 12, () => (triangles ? new Uint32Array(data, at, triangles * 3) : null)),
    edges: next(edges * 8, () => (edges ? new Uint32Array(data, at, edges * 2) : null)),
    distances: next(distances * 4, () => (distances ? new Float32Array(data, at, distances) : null)),
    faces,
  };
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
