# Completion completes options, their words, and the names of files, in each shell that is here.
# bash: what the function of the tool answers to the words of a line; the last one is being typed.
cat > complete.bash << 'BASH'
eval "$("$1" --help bash)"
shift
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
_$1 2> /dev/null
printf '%s\n' "${COMPREPLY[@]}" | LC_ALL=C sort | tr '\n' ' '
echo
BASH
mkdir folder
touch scene.obj
asked() {
  echo "\$ $* <TAB>"
  bash complete.bash "$1" "$@"
}
asked bpmesh --mo
asked bpmesh --mode ''
asked bpmesh --mode in
asked bpmesh --mode = fi
asked bpvox --fill w
asked bpvox sc
asked bpvox --fill none --vo
asked bpvox --voxel ''
asked bpclose --temp ''
asked bpclose --scale 2 --element ''
asked bpinfo --image sc
asked bpmesh --enclose cl
asked bpmesh --enclose ''
asked bpvox --format ''
asked bpmesh --progress ''
asked bpmesh --progress j
asked bplod --prof
# The others parse; fish answers, too.
tools="bpvox bpscale bpclose bpmesh bpcheck bpinfo bplod bpdeform"
command -v bpview > /dev/null && tools+=" bpview" # a build without cpp-httplib has none
for tool in $tools; do
  for shell in bash zsh fish; do
    $tool --help $shell > script
    command -v $shell > /dev/null && ! $shell -n script && echo "$tool: $shell cannot read its script"
  done
  $tool --help zsh > script
  ! command -v zsh > /dev/null || zsh -fc 'autoload -Uz compinit; compinit -u -d dump; functions[_tool]=$(< script); whence -w _tool' > said 2>&1 ||
    { echo "$tool: zsh:"; cat said; }
done
# What zsh and fish offer for a line. zsh: compadd tells its matches, and a widget that it has done.
cat > .ask.zsh << 'ZSH'
zmodload zsh/zpty
cat > .inner.zsh << INNER
autoload -Uz compinit; compinit -u -D
functions[_tool]=\$($1 --help zsh)
compdef _tool $1
compadd() {
  if [[ \${@[1,(i)(-|--)]} == *-[OAD]\ * ]]; then builtin compadd "\$@"; return; fi
  local -a hits
  builtin compadd -A hits "\$@"
  print -l -- \$hits >> .hits
  builtin compadd "\$@"
}
tell() { zle complete-word; touch .done }
zle -N tell
bindkey '^X' tell
touch .ready
INNER
await() { for i in {1..1200}; do [[ -e $1 ]] && return; sleep .05; done; print "no $1" }
rm -f .ready .done .hits
zpty inner zsh -f
zpty -w inner 'source ./.inner.zsh'
await .ready
zpty -w -n inner "$2"$'\C-x'
await .done
zpty -d inner
[[ ! -e .hits ]] || cat .hits
ZSH
export HOME=$PWD XDG_CONFIG_HOME=$PWD/none XDG_DATA_HOME=$PWD/none
offer() {  # SHELL LINE
  if [ "$1" = zsh ]; then zsh -f .ask.zsh "${2%% *}" "$2"; else fish -c "${2%% *} --help fish | source; complete -C'$2'" 2> .said | cut -f 1; fi
}
offers() {  # LINE WORDS: both shells that are here offer these
  for shell in zsh fish; do
    command -v $shell > /dev/null || continue
    got=$(offer $shell "$1" | sed 's|/$||; /^$/d' | LC_ALL=C sort -u | tr '\n' ' ')
    [ "$got" = "$2 " ] || echo "$shell: $1<TAB>: $got instead of $2"
  done
}
rm -f complete.bash script said
offers 'bpmesh --mo' '--mode'
offers 'bpmesh --mode ' 'bounding fit inside'
offers 'bpmesh --enclose c' 'closing'
offers 'bpmesh --enclose s' 'scene scene.obj'
offers 'bpvox --format o' 'obj off'
offers 'bpclose --device c' 'cpu cuda'
offers 'bplod --cache f' 'folder'
