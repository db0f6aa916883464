# Completion for bash. The program itself is asked for its verbs and options, so that this never lags behind it.
_ursula() {
  local word=${COMP_WORDS[COMP_CWORD]} verb=${COMP_WORDS[1]} offered
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    offered=$(ursula --help 2>/dev/null | sed -n '/^Subcommands:/,$s/^  \([a-z-]*\)  .*/\1/p')
    mapfile -t COMPREPLY < <(compgen -W "$offered --help --version" -- "$word")
  elif [[ $word == -* ]]; then
    offered=$(ursula "$verb" --help 2>/dev/null | grep -o -- '^ *\(-h,\)\?--[a-z-]*' | grep -o -- '--[a-z-]*')
    mapfile -t COMPREPLY < <(compgen -W "$offered" -- "$word")
  else
    compopt -o filenames
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}
complete -F _ursula ursula
