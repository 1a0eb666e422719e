# Tilesets that hold the scene itself up close. Two cubes in a row, one with an image.
write_painted_cubes
tiles=(part*.obj --name cubes --voxel 0.1 --tile 128 --profile 3dtiles --leaves scene -q)

bplod "${tiles[@]}" --explain | grep '^leaves\|^disk'
bplod "${tiles[@]}" -o first --cache cache | cut -f 1,2
ls first first/cubes_leaves
bplod "${tiles[@]}" -o again -j 1 --memory 300M --cache cache --report again.json > list
bplod "${tiles[@]}" -o from-nothing -j 1 --memory 300M > list
same first again
same first from-nothing
kept again.json
for f in first/cubes_leaves/*.glb; do
  echo "$f: $(grep -ao '"attributes":{[^}]*}' $f | tr '\n' ' ')$(grep -ao '"images":[^]]*\]' $f) $(grep -ao '"baseColorFactor":[^]]*\]' $f | tr '\n' ' ')"
done | sort | uniq
bpinfo first | grep -o 'tile=.*leaves=[a-z]*'
bpinfo first --level 4 --image x.png 2>&1 > list | sed 's/^/| /'
bpcheck part*.obj first | sed 's/[0-9]* triangles/some triangles/'
bpcheck --json part*.obj first | grep -e tolerance -e thin -e flat

# A changed image is another file, and changes the leaves that show it.
chequer blue
bplod "${tiles[@]}" -o first --overwrite --cache cache --report painted.json > list
bplod "${tiles[@]}" -o painted > list
same first painted
kept painted.json
# A cube that moves changes its own leaves only.
sed -i 's/^v \(.*\) 3 \(.*\)$/v \1 2 \2/' part1.obj
bplod "${tiles[@]}" -o first --overwrite --cache cache --report moved.json > list
bplod "${tiles[@]}" -o moved > list
same first moved
kept moved.json
# Without leaves, theirs are taken away.
bplod part*.obj --name cubes --voxel 0.1 --tile 128 --profile 3dtiles -o first --overwrite -q > list
ls first
# A leaf that is not the scene is found.
leaf=$(ls painted/cubes_leaves/*.glb | head -1)
cp "$leaf" moved/cubes_leaves/"$(basename "$(ls moved/cubes_leaves/*.glb | tail -1)")"
bpcheck part*.obj moved > list || echo "= $?"
grep -c 'does not show\|that the scene does not have' list
# A proxy that its file calls a leaf is none.
cp -r painted called
sed -i -z -E 's/,[[:space:]]*"leaf": true//g; s/"cell": \[/"leaf": true,\n"cell": [/g' called/tileset.json
bpcheck called > list || echo "= $?"
grep -c 'extras.leaf is true, but' list
# A scene in one mesh has one leaf.
bplod part0.obj --resolution 30 --profile 3dtiles --leaves scene -o small -q | cut -f 1,2
bpinfo small | grep -o 'leaves=[a-z]*'
bpcheck part0.obj small | tail -1
try bplod part0.obj -o x --leaves scene
try bplod - --format obj --profile 3dtiles -o x --leaves scene
# Nothing is asked of images that are not wanted.
bplod part0.obj --resolution 30 --profile 3dtiles --leaves scene --appearance off -o bare -q | cut -f 1,2
bpcheck part0.obj bare | tail -1
