# The nightly sample notices each change of what a scene consists of, checks all that it makes, and leaves nothing half done.
mkdir scenes bin
(cd scenes && write_painted_cubes && rm cube.obj part1.obj)
mv scenes/part0.obj scenes/a.obj
table() { sed 's/made in [0-9]* s/made/' | tail -n +2 | cut -f 1-3; }
nightly() { "$BP_ROOT/samples/nightly" "$@" 2> /dev/null | table; }
options=(--faces 12 --levels 1 --resolution 24)
# after WHAT [OPTION...]: whether it is made again after a change, and only once.
after() { echo "$1: $(nightly scenes out "${options[@]}" "${@:2}") $(nightly scenes out "${options[@]}" "${@:2}" | cut -f 2)"; }
after "at first"
mkdir scenes/a.fbm && after "an empty folder with its name"
touch scenes/a.fbm/image.png && after "a file in it that nothing reads"
(cd scenes && chequer blue) && after "an image of its materials"
mv scenes/chequered.png "scenes/chequered 2.png"
sed -i 's/map_Kd .*/\tmap_Kd -s 1 1 1 -clamp on .\\chequered 2.png/' scenes/cubes.mtl && after "the materials"
(cd scenes && chequer red && mv chequered.png "chequered 2.png") && after "an image with a blank and options"
sed -i '/map_Kd/d; /newmtl plain/,$d' scenes/cubes.mtl && printf 'map_Kd -colorspace sRGB chequered 2.png' >> scenes/cubes.mtl
after "a last line without an end, an option that nobody knows"
(cd scenes && chequer green && mv chequered.png "chequered 2.png") && after "the image of that line"
echo '{"base": "4%", "rules": []}' > rules.json && after "rules" --field rules.json
echo '{"base": "5%", "rules": []}' > rules.json && after "other rules" --field=rules.json
# Other formats name images, too: as in addresses, or by a path of another machine.
rm -r scenes/a.obj out && mkdir scenes/textures && touch "scenes/textures/a b.png" scenes/c.jpg
write_cube cube.obj
bpvox cube.obj --resolution 12 | bpmesh -q -o cube.gltf
sed '0,/{/s|{|{"images":[{"uri":"textures\\/a%20b.png"}],|' cube.gltf > scenes/b.gltf
after "glTF"
echo "another" > "scenes/textures/a b.png" && after "an image of glTF"
rm -r scenes/b.gltf out
cat > scenes/c.dae << 'DAE'
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><library_images><image id="i">
<init_from>file:///C:\paint\c.jpg</init_from></image></library_images><library_geometries><geometry id="g"><mesh><source id="p">
<float_array id="f" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array><technique_common><accessor source="#f" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 2 1 0 1 3 1 2 3 2 0 3</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node>
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
DAE
after "COLLADA"
echo "another" > scenes/c.jpg && after "an image of COLLADA that no triangle shows"
rm scenes/c.* scenes/textures -r
# All that is made is checked, as it was made for.
printf '#!/bin/bash\necho "${@/#*\\/}" >> checks\n' > bin/bpcheck
chmod +x bin/bpcheck
write_cube scenes/box_unreal.obj 3
for options in "--profile=cage" "--profile collision --hull-files obj" "--profile gltf" "--mode visual"; do
  echo "$options"
  options=($options --resolution 24 --faces 200)
  PATH=$PWD/bin:$PATH nightly scenes checked "${options[@]}" > table
  cut -f 2,3 table
  cat checks && rm checks
done
for options in "--profile occluder" "--margin 1% --profile cage" "--profile collision --hull-files stl" "--mode fit --profile 3dtiles" "--leaves scene --profile 3dtiles" \
  "--enclose scene" "--mode visual"; do
  nightly scenes proven $options --faces 200 --resolution 24
done
# One night at a time.
ln -s "$(type -P true)" bin/snakemake
try flock out/.lock "$BP_ROOT/samples/nightly" scenes out --faces 12 2>&1 | sed "s|$BP_ROOT/||"
PATH=$PWD/bin:$PATH try flock out/.lock "$BP_ROOT/samples/farm/night" scenes out --faces 12 2>&1 | sed "s|$BP_ROOT/||"
# A night that is told to stop ends what runs, and leaves nothing but what was there.
rm -r out
mkdir empty && nightly scenes out "${options[@]}"
LC_ALL=C ls -A out > before
cat > bin/bplod << SCRIPT
#!/bin/bash
[[ "\$1" != --version && "\$1" != /dev/null ]] || exec $(command -v bplod) "\$@"
echo \$\$ > bplod.pid
exec sleep 60
SCRIPT
cp bin/bplod bin/slow && chmod +x bin/bplod
sed 's/bplod.pid/bpcheck.pid/' bin/slow > bin/bpcheck
PATH=$PWD/bin:$PATH "$BP_ROOT/samples/nightly" scenes out --faces 13 2> /dev/null & night=$!
until [ -s bplod.pid ]; do sleep 0.05; done
kill $night
wait $night
echo "= $?"
kill -0 "$(cat bplod.pid)" 2> /dev/null && echo "bplod goes on"
rm bin/bplod
PATH=$PWD/bin:$PATH "$BP_ROOT/samples/nightly" --one scenes/box_unreal.obj out --faces 13 2> /dev/null & night=$!
until [ -s bpcheck.pid ]; do sleep 0.05; done
kill $night
wait $night
echo "= $?"
kill -0 "$(cat bpcheck.pid)" 2> /dev/null && echo "bpcheck goes on"
LC_ALL=C ls -A out | diff before - && echo "nothing is left behind"
nightly scenes out "${options[@]}"
# A night that is killed ends what runs, too: the next one is not kept out.
cat > bin/bplod << SCRIPT
#!/bin/bash
[[ "\$1" != --version && "\$1" != /dev/null ]] || exec $(command -v bplod) "\$@"
echo \$\$ > bplod.pid
exec sleep 60
SCRIPT
rm bplod.pid
chmod +x bin/bplod
PATH=$PWD/bin:$PATH "$BP_ROOT/samples/nightly" scenes out "${options[@]}" --levels 1 > /dev/null 2>&1 & night=$!
until [ -s bplod.pid ]; do sleep 0.05; done
{ kill -9 $night; wait $night; } 2> /dev/null  # the shell tells of the kill as soon as it sees it
echo "= $?"
timeout 20 flock out/.lock true  # what it ran is given time to end
nightly scenes out "${options[@]}" --levels 1
