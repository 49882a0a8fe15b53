#!/bin/sh
# Installs program, manual pages, completion for bash and plot commands, or removes what it has installed (make install,
# make uninstall). DESTDIR and PREFIX come from the environment, as their names may have any character.
# PREFIX/lib/tiltpad/installed has the checksums of all files; PREFIX/lib/tiltpad/python is the plot commands' own.
#
# usage: install.sh PROGRAM [PYTHON...]       without a Python: no plot commands, as the program needs none
#        install.sh --remove
set -eu
destination=${DESTDIR-}$PREFIX
case $destination in
/*) ;;
*) destination=$PWD/$destination ;;
esac
list=$destination/lib/tiltpad/installed
environment=$destination/lib/tiltpad/python

# the line of a file in the list
line() { (cd "$destination" && sha256sum "$1"); }

# put FILE NAME MODE: what is there stays until the new one is whole, as somebody may be using it
put() {
   new=$destination/$2.new
   install -D -T -m "$3" "$1" "$new"
   mv -fT "$new" "$destination/$2"
   line "$2" >>"$list"
}

# what a command says of itself is its manual page and answers its completion
put_command() {
   put "$2" "bin/$1" 755
   put post/shell/tiltpad.bash "share/bash-completion/completions/$1" 644
   "$destination/bin/$1" --help >"$said"
   awk -f post/shell/man_page.awk -v name="$1" "$said" >"$said.1"
   put "$said.1" "share/man/man1/$1.1" 644
}

if [ "$1" != --remove ]; then
   program=$1
   shift
   mkdir -p "${list%/*}"
   said=$(mktemp)
   new=$said
   trap 'rm -f "$said" "$said.1" "$new"' EXIT
   put_command tiltpad "$program"
   [ $# -gt 0 ] || exit 0
   if [ -e "$environment" ] && ! grep -qx environment "$list"; then
      echo "$environment: is there, and is none that make install has made" >&2
      exit 1
   fi
   echo environment >>"$list"
   "$@" -m venv "$environment"
   rm -rf build/install
   cp -r post build/install
   "$environment/bin/python" -m pip install -q --disable-pip-version-check ./build/install
   for name in plot report collect; do put_command tiltpad-$name post/shell/plot_command; done
   exit
fi

if [ ! -e "$list" ]; then
   echo "$destination: make install has written nothing there" >&2
   exit 1
fi
for name in tiltpad tiltpad-plot tiltpad-report tiltpad-collect; do
   for file in "bin/$name" "share/bash-completion/completions/$name" "share/man/man1/$name.1"; do
      [ -e "$destination/$file" ] || continue
      if line "$file" | grep -qxFf - "$list"; then
         rm "$destination/$file"
      else
         echo "$destination/$file: stays, as it is not what make install wrote"
      fi
   done
done
if grep -qx environment "$list"; then rm -rf "$environment"; fi
rm "$list"
rmdir "${list%/*}" 2>/dev/null || true
