# tiltpad: make run, make test; make help lists the rest.

VERSION := 0.1.0

# ---- what can be set ---------------------------------------------------------------------------
# MODE=release|debug   debug: bounds, floating-point traps, all warnings (others are set by make python, wheel, fuzz)
# FC, FFLAGS           compiler and its optimisation flags
# PREFIX               where make install puts things; PLOTS=no: only the program, without Python
# SUNDIALS_PREFIX, HDF5_PREFIX, FFTW_PREFIX   libraries of a cluster; nothing is installed then
# LAPACK               how to link LAPACK; ARCHIVES=no: shared libraries only (src_f90/libraries.sh)
MODE   ?= release
PREFIX ?= /usr/local
PYTHON ?= python3
ifeq ($(origin FC),default)
FC := gfortran
endif
# names of files and of tests, which may have any character, reach the shell through the environment alone
export FC CC LAPACK ARCHIVES PREFIX DESTDIR ONLY RECORD OLD
# all processors, unless -j says otherwise
ifeq ($(MAKELEVEL)$(filter -j% --jobs%,$(MAKEFLAGS)),0)
MAKEFLAGS += --jobs=$(shell nproc)
endif

# what only tells (make -n, make -q, make help) or needs nothing built writes nothing
only_tells := $(or $(findstring n,$(firstword -$(MAKEFLAGS))),$(findstring q,$(firstword -$(MAKEFLAGS))),\
              $(if $(filter-out help uninstall,$(MAKECMDGOALS)),,yes))

# two in one tree would write the same files: the second waits until the first has ended
ifeq ($(only_tells),)
ifeq ($(MAKELEVEL),0)
$(shell mkdir -p build; if command -v flock >/dev/null; then exec 9>>build/lock; \
   flock -w 1 9 || { echo 'make: another make works in this folder; waiting' >&2; flock 9; }; \
   tail -f -s 0.1 --pid=$$PPID /dev/null >/dev/null 2>&1 & fi)
endif
endif

# ---- flags by compiler: this is the one place ---------------------------------------------------
# Another compiler needs a block of its own and its name in `family`.
#   standard         used always; position-independent, as Python's library is of the same objects
#   heap             added for modules whose arrays may be long
#   modules          stands before the folder of module files
#   release, debug   FFLAGS, if they are not given; plain_release, plain_debug: added to them for modules that compute
#                    little, which compile in half the time; quick_debug: for those whose loops take the tests' time
#   any, alone       FFLAGS for any processor of this kind, and what links the compiler's own libraries in: for a wheel
machine := $(shell uname -m)
family := $(or $(findstring flang,$(notdir $(FC))),$(findstring ifx,$(notdir $(FC))),gfortran)

gfortran.standard := -std=f2018 -fimplicit-none -fopenmp-simd -fPIC -fno-semantic-interposition
gfortran.heap     := -fno-stack-arrays
gfortran.modules  := -J
gfortran.release  := -O3 -march=native -mprefer-vector-width=256 -fstack-arrays
gfortran.plain_release := -O1
gfortran.plain_debug   := -O0
gfortran.quick_debug   := -O3
gfortran.debug    := -O1 -g1 -fcheck=all,no-array-temps -fbacktrace -ffpe-trap=invalid,zero,overflow -Wall -Wextra \
                     -Wno-unused-dummy-argument -Wno-uninitialized -Wno-maybe-uninitialized -Wno-compare-reals -Werror
gfortran.any      := -O3 -fstack-arrays
gfortran.alone    := -static-libgcc -static-libgfortran -l:libgfortran.a $(if $(filter x86_64,$(machine)),-l:libquadmath.a)

flang.standard := -std=f2018 -fimplicit-none -fPIC
flang.heap     := -fno-stack-arrays
flang.modules  := -J
flang.release  := -O3 -march=native -fstack-arrays
flang.debug    := -O1 -g
flang.any      := -O3 -fstack-arrays
flang.alone    :=

ifx.standard := -stand f18 -implicitnone -qopenmp-simd -fPIC
ifx.heap     := -heap-arrays
ifx.modules  := -module #
ifx.release  := -O3 -xHost -fp-model=precise
ifx.debug    := -O1 -g -check all -traceback -fpe0
ifx.any      := -O3 -fp-model=precise
ifx.alone    := -static-intel

ifeq ($(MODE),debug)
FFLAGS ?= $($(family).debug)
B := build/debug
else ifeq ($(MODE),release)
FFLAGS ?= $($(family).release)
B := build
else ifneq ($(filter any x86-64-v3,$(MODE)),)
# for a wheel: any processor of its kind, and those of PCs since about 2013
override FFLAGS := $($(family).any) $(if $(filter x86%,$(MODE)),-march=$(MODE))
B := build/$(MODE)
else ifeq ($(MODE),fuzz)
# for make fuzz: whatever can tell a fault, and which lines and branches a case reaches
override FFLAGS := -O1 -g -fcheck=all,no-array-temps -fbacktrace -ffpe-trap=invalid,zero,overflow \
                   -fsanitize=address,undefined -fno-sanitize-recover=all -fsanitize-coverage=trace-pc --coverage
B := build/fuzz
else
$(error MODE=$(MODE): must be release or debug)
endif

# ---- libraries ---------------------------------------------------------------------------------
prefixes := $(SUNDIALS_PREFIX) $(HDF5_PREFIX) $(FFTW_PREFIX)
# they are words of the compiler's command lines
$(foreach name,SUNDIALS_PREFIX HDF5_PREFIX FFTW_PREFIX,$(if $(word 2,$($(name)))$(strip $(foreach sign,\
   ' " ` $$ \ ; & | < > ( ) { } * ? [ ] ! ~,$(findstring $(sign),$($(name))))),$(error $(name)=$($(name)): must have no \
   blanks, quotes or other signs of the shell; take a link of another name)))
# folders of a prefix are looked for; Debian's are not, as they may be installed only now
modules  := $(if $(SUNDIALS_PREFIX),$(wildcard $(addprefix $(SUNDIALS_PREFIX)/,include/sundials/fortran fortran include)),\
             /usr/include/sundials/fortran) \
            $(if $(HDF5_PREFIX),$(wildcard $(addprefix $(HDF5_PREFIX)/,include mod include/static)),/usr/include/hdf5/serial)
INCLUDE := $(addprefix -I,$(modules)) $(patsubst %,-I%/include,$(SUNDIALS_PREFIX)) -I$(B)/mod
# how a program is linked with them is found out when linking, as they may be installed only now
LIBS := $$(cat $(B)/lib/flags)
alone := $(if $(filter any x86-64-v3,$(MODE)),$($(family).alone) -s)
COMPILE = $(FC) $($(family).standard) $(FFLAGS) $(INCLUDE) $($(family).modules)$(B)/mod

# ---- system packages ---------------------------------------------------------------------------
packages := gfortran libc6-dev libsundials-dev libsundials-fortran-dev libhdf5-dev libfftw3-dev \
            liblapack-dev libblas-dev python3 python3-venv python3-dev
# for one test of make test: a browser that opens a report; for make test-slurm; for make test-debian13
packages.test   := chromium-headless-shell
packages.slurm  := slurmctld slurmd slurm-client munge
packages.debian := debootstrap

wrapper := post/wrap/library.f90
sources := $(sort $(shell find src_f90 tests -name '*.[fF]90')) $(wrapper)
c_sources := $(sort $(shell find src_f90 -name '*.c'))
object = $(patsubst %,$(B)/obj/%.o,$1)
interface = $(patsubst %,$(B)/mod/%.mod,$1)
# what a program is linked from: the modules that it uses (linked.NAME), so that a test builds what it needs alone;
# C of src_f90/app is the main program's alone
objects_of = $(call object,$(linked.$1) $(basename $(notdir $(filter-out src_f90/app/%,$(c_sources))))) $(B)/lib/unused.o
# which modules each source uses
$(foreach line,$(shell awk -f src_f90/dependencies.awk $(sources)),$(eval $(subst ;, ,$(line))))
modules_of = $(basename $(notdir $(filter $(addsuffix /%,$1),$(sources))))
# Arrays whose size comes from the input or from a run are on the heap. FFLAGS may put on the stack those of modules that
# a march or its tables call at each step: these arrays are short, one line of a grid at most.
short := equations_of_motion newton_system bordered_system rigid_rotor state_layout bearing_samples table_film \
         $(filter-out marching sor_film local_cavitation volume_flows fourier_field,\
         $(call modules_of,$(addprefix src_f90/,film/tables film/common film/volumes film/fourier film/sloped pivot bearing integrate)))
heaped := $(filter-out $(short),$(basename $(notdir $(sources))))
# modules that compute little, and what their FFLAGS have besides; not those that a march calls at each step or sample.
# Those named one by one are less than 0.05 % of the instructions of an equilibrium with warm films, of coefficients and
# of a march. Tests, which take longer to compile than the modules under test, have it with the checks alone.
plain := $(filter-out excitations growing_file march_results summary_group recorder,\
         $(call modules_of,$(addprefix src_f90/,system case input storage results app equilibrium branches)) \
         factories film_comparison rotor_factory stability_levels \
         $(if $(filter debug,$(MODE)),$(call modules_of,tests)))
plain_flags := $(if $(filter file override,$(origin FFLAGS)),$($(family).plain_$(if $(filter debug,$(MODE)),debug,release)))
# loops over nodes and matrices: more than half of the time of the test programs, which have their checks all the same
quick := column_elimination interval_maps linear_algebra sommerfeld_nodes sor_sweeps \
         $(call modules_of,src_f90/film/fourier)
quick_flags := $(if $(filter debug,$(MODE)),$(if $(filter file override,$(origin FFLAGS)),$($(family).quick_debug)))
test_names := $(basename $(notdir $(filter tests/unit/test_% tests/physics/test_%,$(sources))))
test_programs := $(addprefix $(B)/tests/,$(test_names))
programs := $(B)/bin/tiltpad $(test_programs) $(B)/fuzz/fuzz_input $(B)/bench/film_bench $(B)/stress/global_search
# what the program says of itself; rewritten only when it changes
commit := $(shell git describe --always --dirty --abbrev=12 2>/dev/null || echo unknown)
define newline


endef
define build_info
!> What the program says of its own making; written by the Makefile.
module build_info
   implicit none (type, external)
   private
   public :: program_version, program_commit, program_flags

   character(len=*), parameter :: program_version = '$(VERSION)'
   character(len=*), parameter :: program_commit = '$(commit)'
   character(len=*), parameter :: program_flags = ''$(foreach flag,$(FFLAGS), &$(newline)     & //' $(subst ','',$(flag))')
end module build_info
endef
flags := $(COMPILE) $(prefixes) $(LAPACK) $(ARCHIVES) heap:$($(family).heap) $(heaped) plain:$(plain_flags) $(plain) \
         quick:$(quick_flags) $(quick)
ifeq ($(only_tells),)
$(shell mkdir -p $(B)/obj $(B)/mod)
# $1: a file, $2: what it must say
renewed = $(if $(and $(findstring x$(file <$1)x,x$2x),$(findstring x$2x,x$(file <$1)x)),,$(file >$1,$2))
$(call renewed,$(B)/obj/build_info.f90,$(build_info))
$(call renewed,$(B)/flags,$(flags))
endif

vpath %.F90 $(sort $(dir $(sources)))
vpath %.c $(sort $(dir $(c_sources)))
vpath %.f90 $(sort $(dir $(sources))) $(B)/obj

VENV := build/venv
venv_python := $(VENV)/bin/python
ross := build/venv-ross

.PHONY: help run build deps python again wheel test ross test-slurm test-debian13 stress realistic fuzz faults \
        bench speed whirl misalignment paper site site-if-mkdocs unit test-programs debug-programs lint format docs install uninstall clean
.DELETE_ON_ERROR:
.SECONDEXPANSION:

help:
	@echo 'make run      installs missing packages, builds, runs input/paper/steady_lugre.nml, draws it into build/run'
	@echo 'make test     installs missing packages, builds, runs every test; ONLY=study: only tests with study in their name'
	@echo 'make unit NAME=test_x   builds and runs one test program of tests/unit or tests/physics, with checks (debug)'
	@echo 'make test-slurm   tries the job scripts of input/slurm on a real Slurm of one node, two minutes (as root)'
	@echo 'make test-debian13   tries make run, make test and the wheel on an empty Debian 13, ten minutes (as root);'
	@echo '                     make test-debian-sid: on another release'
	@echo 'make ross     installs ROSS, a gigabyte of Python packages, and asks it anew what make test compares with'
	@echo 'make stress   runs random cases, half an hour; writes docs/stability.md (CASES=300 SEED=1)'
	@echo 'make realistic   marches bearings as they are built, 25 minutes; writes docs/realistic.md (BEARINGS=200 SEED=1)'
	@echo 'make fuzz     tries random cases and arguments, right and wrong; writes docs/fuzzing.md (MINUTES=5 SEED=1)'
	@echo 'make faults   injects faults from outside into all commands, 20 minutes; writes docs/faults.md (FAULTS=1500 SEED=1)'
	@echo 'make bench    measures run time against error, and other programs, half an hour; writes docs/benchmarks.md'
	@echo 'make speed OLD=COMMIT   compares the speed with that of an older commit, in pairs of runs, twenty minutes'
	@echo 'make whirl    runs the commands of docs/whirl.md and draws its pictures, some minutes'
	@echo 'make misalignment  the same of docs/misalignment.md, a minute'
	@echo 'make paper    makes the figures and checks the claims of the paper, a minute or two; writes docs/paper'
	@echo 'make build    builds build/bin/tiltpad          (MODE=debug: build/debug/bin/tiltpad)'
	@echo 'make deps     installs missing packages (as root or with sudo; otherwise prints the list and stops)'
	@echo 'make python   makes the Python environment build/venv with the package tiltpad and its compiled part'
	@echo 'make wheel    packs build/wheel/tiltpad-*.whl: program, plots, library, for any Linux of this age or later'
	@echo 'make lint     checks style, the order of the floors, words and that no name is unused; make format corrects some of it'
	@echo 'make docs     writes the generated pages of docs (inputs, modules, api, gallery, verification) and docs/images'
	@echo 'make site     builds a site to search from README, docs and input: build/site/pages/index.html'
	@echo 'make install  puts program, plot commands, manual pages and completion into PREFIX ('"$$PREFIX"'); PLOTS=no: no Python'
	@echo 'make uninstall  removes what make install has written there'
	@echo 'make clean    removes build/'

# ---- the two commands --------------------------------------------------------------------------
run: build python
	@mkdir -p build/run
	$(B)/bin/tiltpad input/paper/steady_lugre.nml --overwrite --output build/run/steady_lugre.h5
	@for plot in orbit spectrum hysteresis; do \
	   $(venv_python) $(VENV)/bin/tiltpad-plot $$plot build/run/steady_lugre.h5 -o build/run/$$plot.png || exit 1; \
	   echo "picture: build/run/$$plot.png"; done

test: build python $(VENV)/compiled build/deps-test $(B)/stress/global_search \
      debug-programs site-if-mkdocs
	@TILTPAD="$$PWD/$(B)/bin/tiltpad" $(venv_python) tests/run_all.py $(addprefix build/debug/tests/,$(test_names))

# the debug build and the site, while other parts still load their packages
debug-programs: | build/deps-checked
	@$(MAKE) --no-print-directory MODE=debug test-programs build/debug/fuzz/fuzz_input

site-if-mkdocs: | build/deps-checked
	@if $(MAKE) --no-print-directory build/site/ready; then $(MAKE) --no-print-directory site; \
	   else echo 'no mkdocs: the tests of the site are skipped'; fi

# starts munged, slurmctld and slurmd in a temporary folder, and stops them
test-slurm: build python build/deps-slurm
	@TILTPAD="$$PWD/$(B)/bin/tiltpad" $(venv_python) -m pytest -q -rs -p no:cacheprovider tests/slurm

# the two commands and the wheel on another release of Debian, from nothing (as root)
test-debian13:
	@$(MAKE) --no-print-directory test-debian-trixie
test-debian-%: build/deps-debian
	@tests/debian/try_suite $* build/debian/$*

# asks ROSS what tests compare with, and keeps the answers for make test (tests/post/ross_answers.json.gz)
ross: build python $(ross)/ready
	@TILTPAD="$$PWD/$(B)/bin/tiltpad" TILTPAD_ROSS=ask $(venv_python) -m pytest -q -p no:cacheprovider \
	   tests/post/test_ross*.py tests/post/test_tutorial.py

# random cases; CASES and SEED choose them
CASES ?= 300
SEED   ?= 1
stress: build python $(B)/stress/global_search
	PYTHONPATH=post $(venv_python) tests/stress/stress.py $(B)/bin/tiltpad --search $(B)/stress/global_search \
	   --cases $(CASES) --seed $(SEED) --flutter --searches --report docs/stability.md

# bearings as they are built; a record takes up a study that was stopped
BEARINGS ?= 200
realistic: build python
	PYTHONPATH=post:tests/stress $(venv_python) tests/realistic/realistic.py $(B)/bin/tiltpad \
	   --bearings $(BEARINGS) --seed $(SEED) $(if $(RECORD),--record "$$RECORD") --report docs/realistic.md

# MINUTES and SEED choose what is drawn
MINUTES ?= 5
fuzz: python
	@$(MAKE) --no-print-directory MODE=fuzz build build/fuzz/fuzz/fuzz_input
	@$(MAKE) --no-print-directory MODE=debug build
	$(venv_python) tests/fuzz/fuzz.py build/fuzz/fuzz/fuzz_input build/fuzz/bin/tiltpad build/debug/bin/tiltpad \
	   --minutes $(MINUTES) --seed $(SEED) --report docs/fuzzing.md

# FAULTS and SEED choose what is drawn
FAULTS ?= 1500
faults: build python
	$(venv_python) tests/faults/inject.py $(B)/bin/tiltpad --faults $(FAULTS) --seed $(SEED) --report docs/faults.md

# PARTS='films pads' runs these alone and takes the others from their last run
bench: build python $(VENV)/ready-bench $(ross)/ready $(B)/bench/film_bench
	PYTHONPATH=post $(venv_python) tests/bench/bench.py $(B)/bin/tiltpad $(if $(PARTS),--only $(PARTS))

# OLD=COMMIT is built in a folder of its own, once, and compared with what is here, in pairs of runs
speed: build python
	@test -n "$$OLD" || { echo 'make speed OLD=COMMIT: which commit to compare with' >&2; exit 2; }
	commit=$$(git rev-parse --short=12 --verify "$$OLD^{commit}") && older=build/speed/$$commit && mkdir -p $$older && \
	   { test -e $$older/Makefile || git archive $$commit | tar -x -C $$older; } && \
	   env -u MAKELEVEL -u MAKEFLAGS $(MAKE) -C $$older MODE=$(MODE) build && \
	   mkdir -p build/bench && \
	   $(venv_python) tests/bench/speed.py $$older/$(B)/bin/tiltpad $(B)/bin/tiltpad --commit $$commit \
	   --mode $(MODE) --keep build/bench/speed.txt

# counterparts of the paper's figures, and its claims checked
paper: build python
	PYTHONPATH=post $(venv_python) -m paper $(B)/bin/tiltpad

# what docs/whirl.md and docs/misalignment.md tell, from their own commands
whirl misalignment: build python
	PYTHONPATH=post $(venv_python) docs/$@.py $(B)/bin/tiltpad build/$@

# ---- set-up ------------------------------------------------------------------------------------
deps: build/deps-checked

build/deps-checked:
	@mkdir -p build
ifneq ($(strip $(prefixes)),)
	@echo 'prefixes given: nothing is installed'
else
	@src_f90/packages.sh $(packages)
endif
	@touch $@

# for some tests alone, which are skipped without them
build/deps-%: build/deps-checked
	@$(if $(strip $(prefixes)),,src_f90/packages.sh $(packages.$*) || echo 'tests that need them are skipped')
	@touch $@

python: $(VENV)/ready $(B)/library

# the library for Python, by f2py, of the program's objects of the modules that it uses
FOLDER := post/tiltpad
f2py = $(B)/f2py/$(FOLDER)
$(B)/library: $$(call objects_of,library) $(VENV)/ready $(if $(wildcard $(FOLDER)/_library.*),,again)
	@rm -rf $(FOLDER)/_library.* $(f2py) && mkdir -p $(f2py) && cp $(wrapper) $(f2py)
	root=$$PWD; cd $(f2py) && "$$root/$(venv_python)" -m numpy.f2py --quiet -m _library $(notdir $(wrapper)) >log 2>&1 || \
	   { cat log; exit 1; }
	set -e; eval "$$($(venv_python) post/wrap/paths.py)"; \
	$(COMPILE) -c $(f2py)/_library-f2pywrappers2.f90 -o $(f2py)/wrappers.o; \
	for source in $(f2py)/_librarymodule.c "$$f2py/fortranobject.c"; do \
	   $(CC) -O2 -fPIC -w -I"$$python" -I"$$numpy" -I"$$f2py" -c "$$source" -o $(f2py)/$$(basename "$$source").o; done; \
	$(FC) -shared -s -Wl,--as-needed $(f2py)/*.o $(filter %.o,$^) $(LIBS) -o $(FOLDER)/_library$$suffix
	@touch $@

# What the commands load is compiled at once: else each call compiles it again where Python must not or may not write.
loaded := 'import matplotlib.backends.backend_agg, matplotlib.backends.backend_svg, tiltpad.draw.study_report'

$(VENV)/ready: post/pyproject.toml post/setup.py post/requirements.txt | build/deps-checked
	$(PYTHON) -m venv $(VENV)
	$(venv_python) -m pip install -q --disable-pip-version-check --no-compile -r post/requirements.txt
	$(venv_python) -m pip install -q --disable-pip-version-check --no-build-isolation --no-deps -e post \
	   --config-settings editable_mode=compat
	@PYTHONDONTWRITEBYTECODE= $(venv_python) -c $(loaded) || true
	@touch $@

# so that commands start in less time; also where Python must not write what it has compiled (PYTHONDONTWRITEBYTECODE)
$(VENV)/compiled: $(VENV)/ready
	@$(venv_python) -m compileall -q -j0 -x '/tests?/' $(VENV)/lib post/tiltpad || true
	@touch $@

# A wheel for each Python from 3.11 on whose headers are at hand: program, commands and library, with all that they
# need but glibc, whose version the name of the wheel tells. Each is tried in an environment of its own.
PYTHONS ?= $(shell for p in python3.11 python3.12 python3.13 python3.14 python3.15; do \
   $$p post/wrap/headers.py 2>/dev/null && echo $$p; done)
processors := any $(if $(filter x86_64,$(machine)),x86-64-v3)
wheel: python
	@test -n '$(strip $(PYTHONS))' || { echo 'no Python from 3.11 on with its headers is at hand (PYTHONS=)'; exit 1; }
	@for mode in $(processors); do $(MAKE) --no-print-directory MODE=$$mode build || exit 1; done
	@rm -rf build/wheel
	@$(MAKE) --no-print-directory $(addprefix wheel-,$(PYTHONS))
	@ls -lh build/wheel/*.whl

# from a copy, as setuptools leaves files beside what it packs
wheel-%:
	mkdir -p build/wheel/$*/programs && cp -r post build/wheel/$*/source && rm -f build/wheel/$*/source/tiltpad/_library.*
	$(CC) -O2 -s post/wheel/start.c -o build/wheel/$*/programs/tiltpad
	for mode in $(processors); do cp build/$$mode/bin/tiltpad build/wheel/$*/programs/$$mode || exit 1; done
	mv build/wheel/$*/programs build/wheel/$*/source/
	cp LICENSE build/wheel/$*/source && post/wheel/licences.sh build/any/lib/flags build/wheel/$*/source
	$* -m venv build/wheel/$*/venv
	grep -E '^(numpy|setuptools|wheel)=' post/requirements.txt | build/wheel/$*/venv/bin/python -m pip install -q -r /dev/stdin
	touch build/wheel/$*/venv/ready
	@$(MAKE) --no-print-directory MODE=any VENV=build/wheel/$*/venv FOLDER=build/wheel/$*/source/tiltpad build/any/library
	build/wheel/$*/venv/bin/python -m pip wheel -q --no-build-isolation --no-deps -w build/wheel/$*/raw build/wheel/$*/source
	PATH="$$PWD/$(VENV)/bin:$$PATH" $(venv_python) -m auditwheel repair -w build/wheel build/wheel/$*/raw/*.whl
	tests/wheel/try_wheel build/wheel $* build/wheel/$*/try

# the pages as a site: links to what it shows, as mkdocs takes one folder; where mkdocs cannot be installed, there is none
site: build/site/pages/index.html

build/site/pages/index.html: $(shell find README.md LICENSE docs input -type f 2>/dev/null) build/site/ready
	@mkdir -p build/site/source && ln -sfn $(addprefix ../../../,README.md LICENSE docs input) build/site/source/
	@NO_MKDOCS_2_WARNING=1 build/site/venv/bin/mkdocs build --strict -q -f docs/site/mkdocs.yml
	@echo 'open $@; with the search: python3 -m http.server --directory build/site/pages'

build/site/ready: docs/site/requirements.txt | build/deps-checked
	$(PYTHON) -m venv build/site/venv
	build/site/venv/bin/python -m pip install -q --disable-pip-version-check -r $<
	@touch $@

$(VENV)/ready-bench: tests/bench/requirements.txt $(VENV)/ready
	$(venv_python) -m pip install -q --disable-pip-version-check -r $<
	@touch $@

# ROSS, in an environment of its own. It asks for a later Python than it needs; what it uses is installed as usual.
# Of its packages only what it loads is compiled.
$(ross)/ready: tests/post/ross_requirements.txt | build/deps-checked
	$(PYTHON) -m venv $(ross)
	$(ross)/bin/python -m pip install -q --disable-pip-version-check --no-compile -r $<
	$(ross)/bin/python -m pip install -q --disable-pip-version-check --no-compile --no-deps --ignore-requires-python \
	   ross-rotordynamics==3.1.0
	@PYTHONDONTWRITEBYTECODE= $(ross)/bin/python -c 'import ross' >/dev/null 2>&1 || true
	@touch $@

# ---- build -------------------------------------------------------------------------------------
build: $(B)/bin/tiltpad

$(programs): $$(call objects_of,$$(@F))
	@mkdir -p $(@D)
	@echo 'linking $@'
	@$(FC) $(FFLAGS) -o $@ $^ $(LIBS) $(alone)

$(B)/bin/tiltpad: $(B)/obj/program_start.o

$(B)/obj/%.o: %.f90 $$(call interface,$$(uses.$$*)) $(B)/flags | build/deps-checked
	$(COMPILE) -c $< -o $@

$(B)/obj/%.o: %.F90 $$(call interface,$$(uses.$$*)) $(B)/flags | build/deps-checked
	$(COMPILE) -c $< -o $@

# the compiler leaves a module file that does not change: what uses a module is compiled anew for its interface alone
$(B)/mod/%.mod: $(B)/obj/%.o ;
.PRECIOUS: $(B)/mod/%.mod

$(B)/obj/%.o: %.c $(B)/flags | build/deps-checked
	$(CC) -O2 -fPIC -Wall -Wextra -c $< -o $@

# written above; to make -n new, where they are not there
$(B)/flags $(B)/obj/build_info.f90: ;

$(B)/lib/flags: src_f90/libraries.sh $(B)/flags | build/deps-checked
	@mkdir -p $(@D)
	src_f90/libraries.sh $(@D) $(prefixes) > $@

$(B)/lib/unused.o: $(B)/lib/flags
	$(CC) -O1 -fPIC -w -c $(B)/lib/unused.c -o $@

$(call object,$(heaped)): private override FFLAGS += $($(family).heap)
$(call object,$(plain)): private override FFLAGS += $(plain_flags)
$(call object,$(quick)): private override FFLAGS += $(quick_flags)

test-programs: $(test_programs)

unit:
ifneq ($(words $(NAME)) $(filter $(NAME),$(test_names)),1 $(NAME))
	@echo 'make unit NAME=test_x: NAME is one of'; printf '   %s\n' $(test_names); exit 1
else
	@$(MAKE) -s --no-print-directory MODE=debug build/debug/tests/$(NAME)
	@build/debug/tests/$(NAME)
endif

$(B)/fuzz/fuzz_input $(if $(filter fuzz,$(MODE)),$(B)/bin/tiltpad): $(B)/obj/coverage.o
$(B)/obj/coverage.o: tests/fuzz/coverage.c
	$(CC) -O2 -c $< -o $@

fortran_style := --line-length 120 --ignore S241,C002,C061,C071

# ---- house-keeping -----------------------------------------------------------------------------
lint: python
	$(VENV)/bin/fortitude check $(fortran_style) src_f90 post/wrap tests
	$(VENV)/bin/ruff check --config post/pyproject.toml post tests docs
	$(VENV)/bin/ruff format --check --config post/pyproject.toml post tests docs
	$(venv_python) tests/floors.py
	$(venv_python) tests/unused.py
	$(venv_python) tests/words.py
	$(venv_python) docs/modules.py --check
	$(venv_python) -m mypy --config-file post/pyproject.toml post/tiltpad

format: python
	-$(VENV)/bin/fortitude check --fix $(fortran_style) src_f90 post/wrap tests
	$(VENV)/bin/ruff check --fix --config post/pyproject.toml post tests docs
	$(VENV)/bin/ruff format --config post/pyproject.toml post tests docs

docs: run $(addprefix $(B)/tests/,test_film_accuracy test_fixed_pads test_losses \
      test_rotor_matrices test_mode_selection) $(ross)/ready
	@{ cat docs/inputs_head.md; $(B)/bin/tiltpad --reference; } > docs/inputs.md
	$(venv_python) docs/modules.py
	$(venv_python) docs/api.py > build/api.md && mv build/api.md docs/
	$(venv_python) docs/gallery.py $(B)/bin/tiltpad build/gallery
	$(venv_python) docs/examples.py $(B)/bin/tiltpad build/examples
	$(venv_python) docs/rig.py $(B)/bin/tiltpad
	@mkdir -p docs/images
	cp build/run/*.png docs/images/
	$(venv_python) docs/model_picture.py docs/images/model.png
	$(venv_python) docs/cells.py build/run/steady_lugre.h5 docs/images/cells.png
	$(venv_python) docs/verify.py $(B)/bin/tiltpad > build/verification.md && mv build/verification.md docs/

# Program, manual pages, completion for bash, and the plot commands with an environment of their own (PREFIX/lib/tiltpad).
# PLOTS=no leaves these out, as on a cluster: the program needs no Python.
install: build $(if $(filter no,$(PLOTS)),,python)
	@post/shell/install.sh $(B)/bin/tiltpad $(if $(filter no,$(PLOTS)),,$(PYTHON))

uninstall:
	@post/shell/install.sh --remove

clean:
	rm -rf build post/tiltpad/_library.*
