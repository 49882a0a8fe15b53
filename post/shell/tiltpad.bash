# Completion for bash of tiltpad, tiltpad-plot, tiltpad-report and tiltpad-collect. It has no list of its own: options
# and plots come from --help, variables and their words from tiltpad --reference. `make install` installs it; to try it:
#   . post/shell/tiltpad.bash

# What is typed is compared and never expanded, and never part of a program for awk or sed.

# what a command says, asked once in a shell: _tiltpad_said COMMAND OPTION
declare -gA _tiltpad_answers
_tiltpad_said() {
   local key="$1 $2"
   [[ ${_tiltpad_answers[$key]-} ]] || _tiltpad_answers[$key]=$("$1" "$2" 2>/dev/null)
   printf '%s\n' "${_tiltpad_answers[$key]}"
}

# the input variables, a line each: group%name, then what is allowed
_tiltpad_variables() {
   _tiltpad_said tiltpad --reference | awk -F'|' '/^## &/ { group = substr($1, 5) }
      /^\| `/ { gsub(/[` ]/, "", $2); print group "%" $2, $5 }'
}

# The words of LINE as the shell takes them, without their quotes, and what stands in the last one before its last
# TYPED characters, which readline will replace: _tiltpad_split LINE TYPED. Sets words, before, typed, kept, expands.
_tiltpad_split() {
   local line=$1 quote= word= begun= k c
   for ((k = 0; k < ${#line}; k++)); do
      ((k == ${#line} - $2)) && kept=${#word}
      c=${line:k:1}
      if [[ ! $quote && $c == [[:space:]] ]]; then
         [[ $begun ]] && words+=("$word")
         word= begun= expands=
         continue
      fi
      begun=yes
      if [[ $c == "$quote" ]]; then
         quote=
      elif [[ ! $quote && $c == [\'\"] ]]; then
         quote=$c
      elif [[ $quote != \' && $c == \\ && ( ! $quote || ${line:k+1:1} == [\"\\\$\`] ) ]]; then
         k=$((k + 1))
         word+=${line:k:1}
      else
         [[ $quote != \' && $c == [\$\`] ]] && expands=yes
         word+=$c
      fi
   done
   (($2)) || kept=${#word}
   typed=$word
   before=${words[-1]-}
}

# proposes those of some words that begin with what is typed: _tiltpad_propose WORDS
_tiltpad_propose() {
   local list word
   read -rd '' -a list <<<"$1"
   for word in "${list[@]}"; do
      [[ $word == "$typed"* ]] && COMPREPLY+=("${word:kept}")
   done
}

# files of some endings, and folders: _tiltpad_files ENDING...
_tiltpad_files() {
   local home= file ending
   [[ $typed == \~/* ]] && home=~ && typed=$home${typed:1}
   # variables and the homes of others are left to readline
   [[ $expands || $typed == \~* ]] && compopt -o default && return
   mapfile -d '' -t COMPREPLY < <(
      set +f
      shopt -s nullglob
      shopt -u failglob
      for file in "$typed"*; do
         for ending in / "$@"; do
            [[ $file == *".$ending" || $ending == / && -d $file ]] || continue
            [[ $home ]] && file=\~${file:${#home}}
            printf '%s\0' "${file:kept}"
            break
         done
      done
   )
   compopt -o filenames 2>/dev/null
}

# the value of --set: a variable, or behind its = one of its words
_tiltpad_set() {
   local study= variable allowed word proposed=
   [[ $typed == sweep%* ]] && study=sweep%
   while read -r variable allowed; do
      variable=$study$variable=
      if [[ $typed != *=* ]]; then
         proposed+=" $variable"
      elif [[ ${typed%%=*}= == "$variable" && ! $allowed =~ ^([-0-9]|any|whole) ]]; then
         proposed=" $allowed"
         proposed=${proposed// / $variable}
      fi
   done < <(_tiltpad_variables)
   _tiltpad_propose "$proposed"
   [[ $typed == *=* ]] || compopt -o nospace 2>/dev/null
}

# called by bash as _tiltpad COMMAND TYPED BEFORE
_tiltpad() {
   local IFS=$' \t\n' command=${1##*/} words=() typed before kept=0 expands= help choices= line
   _tiltpad_split "${COMP_LINE:0:COMP_POINT}" ${#2}
   help=$(_tiltpad_said "$command" --help)
   COMPREPLY=()
   while read -r line; do
      [[ $before == -* && $line =~ ^"$before"\ \{([a-z,]*)\} ]] && choices=${BASH_REMATCH[1]//,/ }
   done <<<"$help"
   if [[ $command == tiltpad && $before == --set ]]; then
      _tiltpad_set
   elif [[ $choices ]]; then
      _tiltpad_propose "$choices"
   elif [[ $typed == -* ]]; then
      _tiltpad_propose "$(grep -oE '^ +-.*' <<<"$help" | grep -oE '(^|[ ,])--[a-z]+' | tr -d ' ,')"
   elif [[ $command == tiltpad-plot && ${#words[@]} == 1 ]]; then
      _tiltpad_propose "$(sed -n '/^plots:/,/^$/s/^  \([a-z]*\) .*/\1/p' <<<"$help")"
   elif [[ $command == tiltpad && $before != --output && $before != --resume && $before != -o ]]; then
      _tiltpad_files nml
   else
      _tiltpad_files h5 $([[ $before == --output || $before == -o ]] && echo png pdf svg html)
   fi
}

complete -F _tiltpad tiltpad tiltpad-plot tiltpad-report tiltpad-collect
