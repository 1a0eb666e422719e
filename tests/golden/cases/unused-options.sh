# An option that would mean nothing is refused before any work, in every tool: nobody waits for what was not heard.
write_cube cube.obj
for profile in gltf collision cage; do
  for option in '--tile 64' '--cache c' '--tiles 0..1'; do try bplod cube.obj -o x --profile $profile $option; done
done
try bplod cube.obj -o x --tile 512  # the default, too
try bplod cube.obj -o x --profile collision --appearance color
try bplod cube.obj -o x --mode fit --enclose input
try bplod cube.obj -o x --profile cage --mode fit
for option in --no-tighten --resume '--screen 800' '--element ball'; do try bplod cube.obj -o x $option; done
bpvox cube.obj --resolution 10 -o cube.bpv
bpvox cube.obj --resolution 10 --fill inside -o inside.bpv
try bpclose inside.bpv --keep-cavities --scale 1vx -o x
for option in '--image-size 720' '--up y' '--view 35,22' '--zoom 2' '--look-at 0,0,0'; do
  try bpinfo cube.obj $option
done
# Options of earlier versions: the message names what replaces them.
for option in --no-edges '--azimuth 35' '--elevation 22'; do try bpinfo cube.obj $option; done
for view in 35 35,22,1 a,b; do try bpinfo cube.obj --image x.png --view $view; done
try bpvox cube.obj --device cpu -o x.bpv
for option in '--tile 64' --inner; do try bpclose cube.bpv --scale 2vx $option -o x.bpv; done
for option in --no-tighten --measure '--inset 0.5' '--least-part 0'; do try bpmesh cube.bpv $option -o x.ply; done
try bpcheck cube.obj --look-at 0,0,0
try bpcheck cube.obj --report cube.json --overwrite
try bpcheck cube.obj cube.obj --convex --inside
try bpcheck cube.obj --inside
# Voxels are no mesh, whatever the file is called.
try bpvox cube.obj -o cube.glb
for ending in binvox vox npy vdb nii NII.gz; do try bpvox cube.obj -o cube.$ending; done
try bpclose cube.bpv --scale 1vx -o cube.PLY
# What goes together does.
try bplod cube.obj -o made --profile collision --appearance off --resolution 10 | cut -f 1
try bplod cube.obj -o near --error 50% --enclose closing --levels 1 | cut -f 1
files
# A format that no input needs, or that is none; values that are empty; lengths that count in what is not there.
cp cube.obj nameless
bpmesh cube.bpv -o proxy.glb -q
for format in ply nonsense ''; do
  try bpvox cube.obj --format "$format" -o x.bpv
  try bplod cube.obj --format "$format" -o x
  try bpcheck cube.obj proxy.glb --format "$format"
  try bpinfo proxy.glb --format "$format"
done
try bpvox nameless --format obj --resolution 10 -o nameless.bpv
said 'cat cube.obj | bpvox - cube.obj --format obj --resolution 10 -o piped.bpv'
said 'bpvox nameless --format .OBJ --resolution 10 | cmp - nameless.bpv'
try bpvox '' -o x.bpv
try bpvox cube.obj -o ''
try bpinfo cube.obj --image ''
files
