# Completion of bdpt in bash; made from the options of the command.

# Options of the command $1, and the words that its options are.
_bdpt_options() {
  case $1 in
@OPTIONS@
  esac
}

# Words that option $2 of the command $1 may be: those, "@files" and "@folders"; fails for flags.
_bdpt_values() {
  case $1:$2 in
@VALUES@
    *) return 1 ;;
  esac
}

# The words $1 and, with "@files" or "@folders" among them, paths that begin with $2.
_bdpt_offer() {
  mapfile -t COMPREPLY < <(compgen -W "${1%%@*}" -- "$2")
  if [[ $1 == *@files* ]]; then
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$2")
    compopt -o filenames 2>/dev/null
  elif [[ $1 == *@folders* ]]; then
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -d -- "$2")
    compopt -o filenames 2>/dev/null
  fi
}

_bdpt() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]} values
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    _bdpt_offer "$(_bdpt_options "") --help --version" "$word"
    return
  fi
  if [[ $word == = ]]; then
    word=
  elif [[ $previous == = ]]; then
    previous=${COMP_WORDS[COMP_CWORD-2]}
  fi
  if [[ $previous == -* ]] && values=$(_bdpt_values "$command" "$previous"); then
    _bdpt_offer "$values" "$word"
  elif [[ $word == -* ]]; then
    _bdpt_offer "$(_bdpt_options "$command")" "$word"
  else
    _bdpt_offer "$(_bdpt_values "$command" "")" "$word"
  fi
}

complete -F _bdpt bdpt
