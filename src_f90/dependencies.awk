# Writes for make what each Fortran source uses (a file has the name of its module), with ; for blanks:
#   uses.NAME     the modules that it names, whose objects its own object depends on
#   linked.NAME   itself and all modules that it uses directly or through others: what a program is linked from
#
# usage: awk -f dependencies.awk SOURCES
FNR == 1 {
   parts = split(FILENAME, part, "/")
   name = part[parts]
   sub(/\.[fF]90$/, "", name)
   uses[name] = ""
}
tolower($1) == "use" {
   used = tolower($2)
   sub(/,.*/, "", used)
   uses[name] = uses[name] " " used
}
END {
   uses["build_info"] = ""
   for (name in uses) {
      tell("uses." name, own(uses[name]))
      split("", found)
      tell("linked." name, linked(name, found))
   }
}

function tell(variable, names) {
   gsub(/ /, ";", names)
   print variable ":=" names
}

# those of some modules that are files here
function own(names,   list, count, i, those) {
   count = split(names, list, " ")
   for (i = 1; i <= count; i++) if (list[i] in uses) those = those " " list[i]
   return those
}

function linked(name, found,   list, count, i, those) {
   if (name in found) return ""
   found[name] = 1
   those = " " name
   count = split(own(uses[name]), list, " ")
   for (i = 1; i <= count; i++) those = those linked(list[i], found)
   return those
}
