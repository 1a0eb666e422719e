# Nothing that lies among the scenes, or happened to the disk, stops a night, or makes a later one stale.
mkdir scenes bin
write_cube scenes/a.obj 2
write_cube elsewhere.obj 3
table() { sed 's/made in [0-9]* s/made/' | tail -n +2 | cut -f 1-3; }
options=(--faces 12 --levels 1 --resolution 16)
nightly() { "$BP_ROOT/samples/nightly" scenes out "${options[@]}" "$@" 2> said | table && return "${PIPESTATUS[0]}"; }
# after WHAT: what a night says, how it ends, and whether the next one finds all as it should be.
after() {
  echo "$1:"
  nightly || echo "= $?"
  nightly | cut -f 2 | sort | uniq -c | sed 's/^ */  then /'
}
after "at first"
rm out/a.obj/a_LOD0.glb && after "a level is gone"
: > out/a.obj/a.glb && after "a level is empty"
printf 'x' | dd of=out/a.obj/a.glb bs=1 seek=100 conv=notrunc 2> /dev/null && after "a level is damaged"
rm out/a.obj/levels.tsv && after "the list of levels is gone"
: > out/a.obj/.key && after "a key that a full disk left empty"
head -c 20 out/report.tsv > torn && cp torn out/report.tsv && after "a table that was cut short"
: > out/report.tsv && mkdir out/.a.obj.new && : > out/.a.obj.new/.key && after "what a night on a full disk leaves"
echo "mine" > out/report.tsv && try "$BP_ROOT/samples/nightly" scenes out --faces 12 | sed "s|$BP_ROOT/||"
rm out/report.tsv

# A folder that is not mounted takes nothing away.
nightly > table && mv scenes away && mkdir scenes
try "$BP_ROOT/samples/nightly" scenes out "${options[@]}" | sed "s|$BP_ROOT/||"
cut -f 1 out/report.tsv && rmdir scenes && mv away scenes && after "it is back"

# Links count as what they lead to.
mv scenes/a.obj real.obj && ln -s ../real.obj scenes/a.obj && after "the scene is a link"
write_cube real.obj 5 && after "what it leads to has changed"
ln -sf ../elsewhere.obj scenes/a.obj && after "it leads elsewhere"

# Names and things that are no scenes fail by themselves.
mkfifo scenes/pipe.obj
ln -s /dev/zero scenes/device.ply
ln -s nowhere scenes/broken.stl
mkdir scenes/folder.obj
write_cube scenes/.hidden.obj
write_cube $'scenes/tab\there.obj'
write_cube $'scenes/line\nbreak.obj'
write_cube "scenes/-a 'quoted' \"name\" \$x.obj"
write_cube $'scenes/latin-\xe9.obj'
nightly | iconv -f latin1 -t utf8 || echo "= $?"
rm scenes/pipe.obj scenes/device.ply scenes/broken.stl scenes/.hidden.obj scenes/$'tab\there.obj' scenes/$'line\nbreak.obj'
nightly | iconv -f latin1 -t utf8
ls -A out | grep -c '\.log$'

# Pipes and devices that a scene names are not waited for.
mkfifo fifo
printf 'mtllib ../fifo\n' | cat - real.obj > scenes/a.obj.new && rm -r scenes/*.obj && mv scenes/a.obj.new scenes/a.obj && nightly
rm scenes/a.obj
for uri in ../fifo /dev/zero; do
  printf '{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"%s"}]}' $uri > scenes/g.gltf
  try bpvox scenes/g.gltf --resolution 8 -o g.bpv
done
rm scenes/g.gltf

# What lies beside a scene and is not read costs nothing, and makes nothing anew: links out of the folder and back, files without an end,
# words that may be names.
write_cube scenes/a.obj 2
ln -s /proc scenes/a.proc && ln -s ../out scenes/a.out && truncate -s 4T scenes/a.dat
printf 'mtllib a.mtl\n' | cat - scenes/a.obj > a.obj && mv a.obj scenes/a.obj
{ printf 'newmtl a\nmap_Kd'; printf ' word%d' {1..4000}; printf '\n'; } > scenes/a.mtl
after "things beside a scene"
rm scenes/a.*

# A scene that has no end is given up.
write_cube scenes/a.obj 2
printf '#!/bin/bash\n[[ "$*" == *a.obj* ]] || exec "$REAL" "$@"\nsleep 100\n' > bin/bplod
chmod +x bin/bplod
REAL=$(type -P bplod) PATH=$PWD/bin:$PATH nightly --time-limit 1s || echo "= $?"
try "$BP_ROOT/samples/nightly" scenes out --time-limit soon | sed "s|$BP_ROOT/||"
