# What a COLLADA file says that programs read in different ways: nothing is proven of it. A cube of 1, in a cube of 8.
python3 - << 'PY'
corners = [(x, y, z) for z in (-4, 4) for y in (-4, 4) for x in (-4, 4)]
faces = "021 123 456 576 014 154 263 367 042 246 135 375".split()
with open("proxy.obj", "w") as f:
    f.writelines("v %d %d %d\n" % p for p in corners)
    f.writelines("f %d %d %d\n" % tuple(int(i) + 1 for i in t) for t in faces)
PY
cp "$BP_ROOT"/tests/data/bugs/collada_*.dae .
# element NAME TEXT: a node with this transform.
element() {
  sed "s|<skew>.*</skew>|$2|" "collada_skew.dae" > "$1.dae"
  local answer=$(bpcheck "$1.dae" proxy.obj 2> said | tail -1)
  echo "$1: ${answer:-$(cat said)}"
}
element matrix "<matrix>1 0 0 0.1 0 1 0 0.2 0 0 1 0.3 0 0 0 1</matrix>"
element translate "<translate>0.1 0.2 0.3</translate>"
element scale "<scale>2 1 0.5</scale>"
element rotate "<rotate>0.6 0 0.8 40</rotate>"
element rotate-few-digits "<rotate>0.577350 0.577350 0.577350 40</rotate>"
element rotate-long-axis "<rotate>0 0 2 40</rotate>"
element lookat "<lookat>0 0 0 0 0 -1 0 1 0</lookat>"
element lookat-slanted-up "<lookat>0 0 0 0 1 -1 0 1 0</lookat>"
element skew "<skew>45 0 1 0 1 0 0</skew>"
element skew-by-nothing "<skew>0 0 1 0 1 0 0</skew>"
# Translations that cancel: an importer in float32 is off by a metre there, and the reader in double is not.
element cancelled "<translate>448000.3 5412345.3 33</translate><rotate>0 0 1 90</rotate><translate>-5412345.3 448000.3 -33</translate>"
sed 's|</visual_scene>|<node><instance_node url="other.dae#n"/></node></visual_scene>|' scale.dae > other.dae
echo "a node of another file: $(bpcheck other.dae proxy.obj 2> said | tail -1)"
# A skin whose joint has moved by 1, and one as it was bound.
bpcheck "collada_skin.dae" proxy.obj | grep -E "followed|decided"
try bpvox "collada_skin.dae" --resolution 16 -o skin.bpv
sed 's|0 0 6<|0 0 5<|' "collada_skin.dae" > bound.dae
echo "a skin as bound: $(bpcheck bound.dae proxy.obj 2> said | tail -1)"
sed 's|<vcount>1|<vcount>0|; s|<v>0 0|<v>|' bound.dae > free.dae
echo "a vertex without a joint: $(bpcheck free.dae proxy.obj 2> said | tail -1)"
try bpcheck "collada_morph.dae" proxy.obj

# A proxy is read as a scene is: what programs may draw elsewhere proves nothing, and refutes nothing.
printf 'v 0.2 0.3 0.4\nv 0.3 0.3 0.4\nv 0.2 0.4 0.5\nf 1 2 3\n' > inner.obj
# last COMMAND...: its last line, or what it said.
last() {
  local answer=$("$@" 2> said | tail -1)
  echo "$* = ${answer:-$(cat said)}"
}
for name in bound collada_skin free other rotate-long-axis lookat-slanted-up collada_skew collada_morph; do
  last bpcheck $name.dae
  last bpcheck inner.obj $name.dae
done
last bpcheck proxy.obj bound.dae
last bpcheck proxy.obj collada_skin.dae
last bpcheck collada_skin.dae inner.obj
last bpcheck --convex inner.obj collada_skin.dae
last bpcheck --inside proxy.obj collada_skin.dae
last bpcheck --margin 0.01 inner.obj collada_skin.dae
try bpcheck inner.obj collada_skin.dae > /dev/null
bpcheck --json inner.obj collada_skin.dae 2> said | grep -A6 not_followed

# Every tool that reads such a file says so: bpmesh of what it encloses, bpdeform of a cage, bpinfo.
bpvox proxy.obj --resolution 16 -q -o proxy.bpv
try bpmesh proxy.bpv --enclose collada_skin.dae --faces 12 -o enclosed.obj
try bpdeform bind inner.obj collada_skin.dae --outside near -o inner.bpw
try bpdeform apply inner.bpw collada_skin.dae collada_skin.dae -o moved.obj
bpinfo collada_skin.dae | grep unread
