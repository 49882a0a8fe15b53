# Completion for bash of tiltpad, tiltpad-plot, tiltpad-report and tiltpad-collect. It has no list of its own: options
# and plots come from --help, variables and their words from tiltpad --reference. `make install` installs it; to try it:
#   . post/shell/tiltpad.bash

# what a command says, asked once in a shell: _tiltpad_said COMMAND OPTION
declare -A _tiltpad_answers
_tiltpad_said() {
   local key="$1 $2"
   [[ ${_tiltpad_answers[$key]} ]] || _tiltpad_answers[$key]=$("$1" "$2" 2>/dev/null)
   printf '%s\n' "${_tiltpad_answers[$key]}"
}

# the input variables, a line each: group%name, then what is allowed
_tiltpad_variables() {
   _tiltpad_said tiltpad --reference | awk -F'|' '/^## &/ { group = substr($1, 5) }
      /^\| `/ { gsub(/[` ]/, "", $2); print group "%" $2, $5 }'
}

# proposes those words that begin with what is typed
_tiltpad_propose() { mapfile -t COMPREPLY < <(compgen -W "$2" -- "$1"); }

# files of some endings, and folders: _tiltpad_files TYPED ENDING...
_tiltpad_files() {
   local typed=$1 ending
   shift
   mapfile -t COMPREPLY < <(compgen -d -S / -- "$typed"; for ending; do compgen -f -X "!*.$ending" -- "$typed"; done)
   compopt -o nospace -o filenames 2>/dev/null
}

# the value of --set: a variable, or behind its = one of its words
_tiltpad_set() {
   local typed=$1 name=${1%%=*} prefix=
   [[ $name == sweep%* ]] && prefix=sweep% && name=${name#sweep%}
   if [[ $typed == *=* ]]; then
      # readline sees the value alone, as = parts words
      _tiltpad_propose "${typed#*=}" "$(_tiltpad_variables | awk -v name="$name" '$1 == name && $2 !~ /^[-0-9]/ && \
         $2 !~ /^(any|whole)/ { $1 = ""; print }')"
   else
      _tiltpad_propose "$typed" "$(_tiltpad_variables | awk -v prefix="$prefix" '{ print prefix $1 "=" }')"
      compopt -o nospace 2>/dev/null
   fi
}

_tiltpad() {
   local command=${COMP_WORDS[0]##*/} line=${COMP_LINE:0:COMP_POINT} words typed before help choices
   # words as the shell has them, not parted at = and :
   read -ra words <<<"$line"
   [[ $line == *[[:space:]] ]] && words+=('')
   typed=${words[-1]}
   before=${words[-2]}
   help=$(_tiltpad_said "$command" --help)
   COMPREPLY=()
   choices=$(sed -n "s/^ *$before {\([a-z,]*\)}.*/\1/p" <<<"$help")
   if [[ $command == tiltpad && $before == --set ]]; then
      _tiltpad_set "$typed"
   elif [[ $choices ]]; then
      _tiltpad_propose "$typed" "${choices//,/ }"
   elif [[ $typed == -* ]]; then
      _tiltpad_propose "$typed" "$(grep -oE '^ +-.*' <<<"$help" | grep -oE '(^|[ ,])--[a-z]+' | tr -d ' ,')"
   elif [[ $command == tiltpad-plot && ${#words[@]} == 2 ]]; then
      _tiltpad_propose "$typed" "$(sed -n '/^plots:/,/^$/s/^  \([a-z]*\) .*/\1/p' <<<"$help")"
   elif [[ $command == tiltpad && $before != --output && $before != --resume && $before != -o ]]; then
      _tiltpad_files "$typed" nml
   else
      _tiltpad_files "$typed" h5 $([[ $before == --output || $before == -o ]] && echo png pdf svg html)
   fi
}

complete -F _tiltpad tiltpad tiltpad-plot tiltpad-report tiltpad-collect
