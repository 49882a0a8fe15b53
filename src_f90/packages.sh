#!/bin/sh
# Installs those of some Debian packages that are missing; without the rights to do so, lists them and fails.
#
# usage: packages.sh PACKAGE...
if ! command -v dpkg-query >/dev/null; then
   echo "no Debian packages here: taking libraries from the compiler's own paths"
   exit
fi
missing=
for package; do
   dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" = 0 ]; then
   sudo=
elif sudo -n true 2>/dev/null; then
   sudo=sudo
else
   echo 'missing packages; install them and call make again:'
   echo "  apt-get install$missing"
   exit 1
fi
echo "installing:$missing"
$sudo apt-get update -qq &&
   $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends $missing >/dev/null
