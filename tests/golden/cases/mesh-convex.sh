# Around what is flat, or convex, a proxy is a box or a hull where others hold more or reach farther out.
printf 'v 0 0 0\nv 4 1 0.3\nv 4.5 3 3\nv 0.5 2 2.7\nf 1 2 3 4\n' > slant.obj
printf 'v 0 0 0\nv 10 0 0\nv 10 0 10\nv 0 0 10\nf 1 2 3\nf 1 3 4\n' > ground.obj
mesh() {  # SCENE FACES...
  bpvox "$1.obj" | bpclose --scale 2% -o "$1.bpv" --overwrite
  for faces in "${@:2}"; do
    try bpmesh "$1.bpv" --faces "$faces" -o proxy.ply --overwrite
    bpinfo proxy.ply | grep -E '^(triangles|bounds|volume)'
    bpcheck "$1.obj" proxy.ply | tail -1
  done
}
mesh slant 12 200
mesh ground 50 200

# Each level holds the one before.
try bpmesh slant.bpv --faces 64,20,12 -o chain.ply -q
bpcheck slant.obj chain.0.ply | tail -1
for i in 0 1; do bpcheck chain.$i.ply chain.$((i + 1)).ply | tail -1; done
bpmesh slant.bpv --faces 12 -j 1 -o again.ply -q && cmp again.ply <(bpmesh slant.bpv --faces 12 -j 2 -o two.ply -q && cat two.ply) && echo "the same bytes"
