// Reads geometry as the server sends it (tools/view/geometry/wire.h, tools/view/geometry/shown_mesh.h).
import type { Vec3 } from './api';

export interface Mesh { positions: Float32Array; normals: Int8Array | null; corners: Uint32Array | null; edges: Uint32Array | null; distances: Float32Array | null; faces: number }
export interface Piece { key: string; brick: Vec3; vertices: number; bytes: ArrayBuffer; corners: Uint16Array | Uint32Array }
/// whole: pieces from before are gone. voxel, origin: edge of a voxel that is drawn, and the place of voxel (0,0,0).
export interface Surface { generation: number; whole: boolean; voxel: number; origin: Vec3; pieces: Piece[] }

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

/// The two triangles of each face.
function trianglesOf<T extends Uint16Array | Uint32Array>(faces: T, triangles: T): T {
  for (let i = 0, at = 0; i < faces.length; i += 4) {
    for (const k of [0, 1, 2, 0, 2, 3]) triangles[at++] = faces[i + k];
  }
  return triangles;
}

export function readSurface(data: ArrayBuffer): Surface {
  const [generation, whole, count] = new Uint32Array(data, 0, 4), [voxel, ...origin] = new Float64Array(data, 16, 4);
  const pieces: Piece[] = [];
  for (let at = 48, i = 0; i < count; ++i) {
    const [x, y, z] = new Int32Array(data, at, 3);
    const [vertices, faces] = new Uint32Array(data, at + 12, 2);
    at += 20;
    const bytes = data.slice(at, at + vertices * 12);
    at += vertices * 12;
    const wide = vertices > 65535;
    const corners = wide ? trianglesOf(new Uint32Array(data, at, faces * 4), new Uint32Array(faces * 6))
      : trianglesOf(new Uint16Array(data, at, faces * 4), new Uint16Array(faces * 6));
    pieces.push({ key: `${x},${y},${z}`, brick: [x, y, z], vertices, bytes, corners });
    at += faces * (wide ? 16 : 8);
  }
  return { generation, whole: whole === 1, voxel, origin: origin as Vec3, pieces };
}
