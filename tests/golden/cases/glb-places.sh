# A GLB holds scene units, and its nodes nothing that moves or scales: a program that takes the mesh alone gets its size and place.
write_cube cube.obj 3
sed 's/^v \(.*\) \(.*\) \(.*\)$/echo v $((\1 + 500000)) $((\2 + 5400000)) \3/e' cube.obj > far.obj
sed 's/^v 3 3 3/v 3 3 9/' cube.obj > tall.obj
places() {
  for f in "$@"; do
    echo "$f: $(grep -ao '"nodes":\[{.*"meshes"' "$f" | sed 's/,"meshes"//') $(grep -ao '"min":[^]]*],"max":[^]]*]' "$f" | tr '\n' ' ')"
  done
}
pipe() { bpvox "$1" --resolution 40 "${@:3}" | bpclose --scale 2vx | bpmesh --faces 12 -q -o "$2"; }
pipe cube.obj cube.glb
pipe tall.obj tall.gltf --up z
tr -d ' \n' < tall.gltf > tall-line.gltf
places cube.glb tall-line.gltf
said 'bpcheck tall.obj tall.gltf | tail -1'
# A voxel that is asked for is rounded up, by a 128th at most, so that floats hold the lattice.
bpvox cube.obj --voxel 0.1 | bpinfo | grep '^voxel'
bpvox cube.obj --voxel 0.1 | bpmesh --faces 12 -q -o asked.glb
places asked.glb
bpvox cube.obj --voxel 0.1 | bpmesh --faces 12 -q -o asked.stl
said 'bpcheck cube.obj asked.stl | tail -1'
# Every profile does so, and several meshes of a file stand together.
for profile in gltf collision occluder cage; do bplod tall.obj --profile $profile --name a --up z --resolution 40 --levels 1 -q -o $profile > list 2>&1; done
for profile in gltf collision occluder cage; do places $profile/*.glb; done
# Far from its origin a scene's files have a translation alone, of few bits; with --origin they need none.
pipe far.obj far.glb
bpvox far.obj --resolution 40 | bpmesh --faces 12 --origin auto -q -o origin.glb
bplod far.obj --resolution 40 --profile collision --up z -q -o body > list
places far.glb origin.glb body/far_*.glb
said 'bpcheck far.obj far.glb | tail -1'  # and how far programs that compute in floats may draw it elsewhere
said 'bpcheck far.obj origin.glb | tail -1'
# Tiles are quantized: their nodes have a scale.
bplod cube.obj --profile 3dtiles --resolution 40 --levels 1 -q -o tiles > list
places tiles/*.glb
# What floats cannot hold has whole numbers in the file, and a node that says where and how large they are.
sed 's/^v 3/v 3000/' cube.obj > long.obj
bpvox long.obj --voxel 0.3 | bpmesh --faces 12 -q -o long.glb
places long.glb
said 'bpcheck long.obj long.glb | tail -1'
