# Every GLB that is made, in every mode and profile, is lit at once in every viewer: normals, and a matte material with a name.
write_cube cube.obj 3
looks() {
  find "$@" -name '*.glb' | sort | while read -r f; do
    echo "$f: $(grep -ao '"POSITION"' "$f" | wc -l) positions, $(grep -ao '"NORMAL"' "$f" | wc -l) normals, $(grep -ao '"material":[0-9]*' "$f" | wc -l) with a material; $(grep -ao '"name":"matte[^"]*"\|"metallicFactor":[^,}]*\|"roughnessFactor":[^,}]*\|"doubleSided":[^,}]*' "$f" | sort | uniq | tr '\n' ' ')"
  done
}
mkdir made
bpvox cube.obj --resolution 30 | bpclose --scale 5% > cube.bpv
for mode in bounding inside fit; do bpmesh cube.bpv --mode $mode --faces 100 -q -o made/$mode.glb; done
for profile in gltf 3dtiles collision occluder cage; do bplod cube.obj --profile $profile --resolution 30 -q -o made/$profile | true; done
echo 'newmtl red
Kd 1 0 0' > red.mtl
{ echo "mtllib red.mtl"; echo "usemtl red"; cat cube.obj; } > red.obj
for appearance in auto texture color off; do bplod red.obj --appearance $appearance --resolution 30 --levels 1 -q -o made/$appearance | true; done
looks made
