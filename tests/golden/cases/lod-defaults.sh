# What bplod makes of a scene if nobody says what: levels that follow from its triangles.
write_cube cube.obj 3
write_octahedron octahedron.obj 3
# A cube is one level of as many faces; nothing is tried, or said, beyond that.
said 'bplod cube.obj -o cube | cut -f 1,2'
said 'bplod cube.obj --explain -q | tail -2 | cut -f 1,2,7'
said 'bplod octahedron.obj -o octahedron | cut -f 1,2'
said 'bplod octahedron.obj --profile collision -o collision | cut -f 1,2'
ls cube
# A plant: half of its triangles, then a quarter each; fewer, near which nothing else is asked for, if levels are counted.
bp-plant --triangles 10000 -o plant.ply > list
triangles=$(bpinfo plant.ply | awk '/^triangles/ { print $2 }')
shares() { awk -F '\t' -v all="$triangles" 'NR > 1 { printf "%s %s\n", $1, ($2 <= all / '"$1"' / 4 ^ (NR - 2) ? "keeps its share" : "has too many: " $2) }'; }
bplod plant.ply -q -o plant | shares 2
bplod plant.ply --explain -q | awk -F '\t' '/^[0-9]/ { print $1, $7 }' | sed "s/$((triangles / 2))/half/"
for i in 0 1; do bpcheck plant.ply plant/plant_LOD$i.glb | tail -1; done
bplod plant.ply --levels 1 --faces 12.5% -q -o share --report share.json | shares 8
sed -n '/"faces": \[/,/\]/p; /"levels": [0-9n]/p' share.json
bplod plant.ply --profile collision --explain -q | awk -F '\t' '/^[0-9]/ { print $1, $7 }' | sed "s/$((triangles / 8))/an eighth/"
# Voxels that are named decide the faces, but never more than half of the scene's triangles.
bplod plant.ply --resolution 40 --explain -q | awk -F '\t' '/^[0-9]/ { print $1, $7 }'
bplod cube.obj --resolution 100 --explain -q | awk -F '\t' '/^[0-9]/ { print $1, $7 }'
# Percentages: of the same scene the same levels as numbers.
bplod plant.ply --faces 10%,1% -q -o percent > percent.tsv
bplod plant.ply --faces $(((triangles + 5) / 10)),$(((triangles + 50) / 100)) -q -o numbers > numbers.tsv
diff -r percent numbers && echo "the same bytes"
try bplod cube.obj --faces 50%,20 -o x
try bplod cube.obj --faces 50%,60% -o x
try bplod cube.obj --faces 120% -o x
try bplod cube.obj --faces % -o x
try bplod cube.obj --faces 50% --error 1 -o x
try bplod cube.obj --faces 50%,10% --profile collision -o x
try bplod cube.obj --faces 50% --profile 3dtiles -o x
bpvox cube.obj --resolution 20 -o cube.bpv
try bpmesh cube.bpv --faces 50% -o x.glb
files
# The disk space that --explain names is what a build takes, within a factor of two.
for profile in gltf 3dtiles; do
  bplod plant.ply --profile $profile --resolution 200 --explain -q --overwrite --report explained.json > explained
  bplod plant.ply --profile $profile --resolution 200 -q -o disk > listed
  about=$(grep -o '"file_bytes_about": [0-9]*' explained.json | grep -o '[0-9]*$') real=$(cat $(find disk -type f) | wc -c)
  [ $((2 * about)) -gt $real ] && [ $about -lt $((2 * real)) ] || echo "$profile: about $about bytes, and $real were written"
  rm -r disk listed explained explained.json
done

# A profile that joins separate parts says so, and how they stay apart.
write_cube cube1.obj 1
awk '/^v/ { v[++n] = $0 } /^f/ { f[++m] = $0 } END {
  for (k = 0; k < 64; ++k) {
    for (i = 1; i <= n; ++i) { split(v[i], p); print "v", p[2] + k % 4 * 2, p[3] + int(k / 4) % 4 * 2, p[4] + int(k / 16) * 2 }
    for (i = 1; i <= m; ++i) { c = split(f[i], q); t = "f"; for (j = 2; j <= c; ++j) t = t " " q[j] + k * n; print t }
  }
}' cube1.obj > blocks.obj
said 'bplod blocks.obj --profile collision -o blocks | cut -f 1,2'
said 'bplod blocks.obj --profile collision --faces 768 -o blocks --overwrite | cut -f 1,2'

# The hulls of a body of few faces may have more faces than it: those of an L are two boxes.
awk '/^v/ { v[++n] = $0 } /^f/ { f[++m] = $0 } END {
  for (k = 0; k < 2; ++k) {
    for (i = 1; i <= n; ++i) { split(v[i], p); print "v", p[2] * (k ? 1 : 6), k + p[3] * (k ? 4 : 1), p[4] }
    for (i = 1; i <= m; ++i) { c = split(f[i], q); t = "f"; for (j = 2; j <= c; ++j) t = t " " q[j] + k * n; print t }
  }
}' cube1.obj > L.obj
said 'bplod L.obj --profile collision -o L | cut -f 1,2'
