#!/bin/sh
# Copies the licences of what a program of a wheel contains: for each archive that it is linked with, what Debian says
# of the package, as FOLDER/LICENSE.PACKAGE, where setuptools finds it. Elsewhere nothing is copied.
# usage: post/wheel/licences.sh FILE-WITH-LINK-FLAGS FOLDER          environment: FC
command -v dpkg-query >/dev/null || exit 0
for archive in $(tr ' ' '\n' < "$1" | grep '^/.*\.a$') \
   "$($FC -print-file-name=libgfortran.a)" "$($FC -print-file-name=libquadmath.a)"; do
   package=$(dpkg-query -S "$(readlink -f "$archive")" 2>/dev/null | sed 's/:.*//;q')
   [ ! -e "/usr/share/doc/$package/copyright" ] || cp "/usr/share/doc/$package/copyright" "$2/LICENSE.$package"
done
