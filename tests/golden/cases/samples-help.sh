# The samples' own commands tell how they are used on stdout, and start nothing.
for command in run nightly scenes.py town.py softbody.py; do
  said "\"\$BP_ROOT/samples/$command\" --help | sed -n 1,2p"
done
said '"$BP_ROOT/samples/run" --resolution 64'
files
