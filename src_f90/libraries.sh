#!/bin/sh
# Prints how to link SUNDIALS, HDF5, FFTW and LAPACK: their archives where there are any, else their shared libraries.
# A program of archives starts sooner (docs/benchmarks.md, Production), and needs no library on the machine that runs it
# but the C and Fortran compilers' own.
#
# usage: libraries.sh FOLDER [PREFIX...]     environment: FC, CC; LAPACK (flags of one's own); ARCHIVES=no (shared
# libraries)
#
# An archive may refer to what this program never uses: SUNDIALS of some distributions to MPI, which would bring some
# 60 libraries and a sixth of a second to every start; HDF5 to libraries for files in web storage. Such references are
# met by functions that do nothing, written to FOLDER/unused.c: to MPI_Initialized, which SUNDIALS calls, that says no.
folder=$1
shift
archives= flags= missing= folder_of_its_own=

# candidates for a file in one place: a prefix, or where the compiler looks. Debian keeps reference LAPACK, which
# starts no threads for our small systems, in a folder beside OpenBLAS.
files() {
   if [ "$1" = system ]; then
      $CC -print-file-name="$folder_of_its_own$2"
      $CC -print-file-name="$2"
   else
      ls "$1"/lib*/"$2" "$1"/lib*/*-linux-gnu/"$2" 2>/dev/null
   fi
}

# the first file of a library called by one of these names
find_library() {
   for place in $prefixes system; do
      for name; do
         for ending in $endings; do
            for file in $(files "$place" "lib$name$ending"); do
               [ -e "$file" ] && echo "$file" && return
            done
         done
      done
   done
   return 1
}

# links a library called by one of these names
link() {
   file=$(find_library "$@")
   case $file in
   '') missing="$missing $1" ;;
   *.a)
      file=$(readlink -f "$file")
      archives="$archives $file" flags="$flags $file"
      ;;
   *) flags="$flags $file -Wl,-rpath,$(cd "${file%/*}" && pwd)" ;;
   esac
}

# links what only some builds of a library have
link_if_there() { [ -z "$(find_library "$@")" ] || link "$@"; }

# symbols that the archives want of libraries called so
wanted() { [ -z "$archives" ] || nm -u $archives 2>/dev/null | sed -n "s/^ *U \($1\)\$/\1/p"; }

: "${CC:=cc}"
prefixes=$*
[ "$ARCHIVES" = no ] && endings=.so || endings='.a .so'
for name in fcvode_mod fnvecserial_mod fsunmatrixdense_mod; do link sundials_$name; done
link_if_there sundials_fcore_mod
for name in cvode nvecserial sunmatrixdense; do link sundials_$name; done
link_if_there sundials_core
unused=$(wanted '\(MPI\|ompi\)_[A-Za-z0-9_]*')
all_flags=$flags archives= flags=

link hdf5_serialhl_fortran hdf5_serial_hl_fortran hdf5hl_fortran hdf5_hl_fortran
link_if_there hdf5_serial_hl_f90cstub hdf5_hl_f90cstub
link hdf5_serial_hl hdf5_hl
link hdf5_serial_fortran hdf5_fortran
link_if_there hdf5_serial_f90cstub hdf5_f90cstub
link hdf5_serial hdf5
# an HDF5 that works with MPI calls it in earnest, and its user links with MPI
! grep -qs MPI_Initialized "$file" || unused=
if [ -n "$archives" ]; then for name in sz aec z; do link_if_there $name; done; flags="$flags -lpthread"; fi
unused="$unused $(wanted '\(curl\|EVP\|aws\)_[A-Za-z0-9_]*\|HMAC\|SHA256')"
all_flags="$all_flags $flags" flags=

link fftw3
if [ -n "$LAPACK" ]; then
   for prefix in $prefixes; do
      for libraries in "$prefix/lib" "$prefix/lib64"; do
         [ ! -d "$libraries" ] || flags="$flags -L$libraries -Wl,-rpath,$libraries"
      done
   done
   flags="$flags $LAPACK"
else
   # a distribution's is built by gfortran: for another compiler, the shared one brings gfortran's own library along
   case $FC in *gfortran*) ;; *) endings=.so ;; esac
   folder_of_its_own=lapack/ && link lapack
   folder_of_its_own=blas/ && link blas
fi
if [ -n "$missing" ]; then
   echo "libraries not found:$missing" >&2
   exit 1
fi
for symbol in $(printf '%s\n' $unused | sort -u); do echo "int $symbol(void) { return 0; }"; done > "$folder/unused.c"
# HDF5 and program_start.c look up functions
echo "-Wl,--start-group $all_flags -Wl,--end-group $flags -ldl"
