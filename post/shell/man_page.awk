# A manual page from what a command says of itself.   COMMAND --help | awk -f post/shell/man_page.awk -v name=COMMAND
# Headings stand at the margin and end in a colon; an entry is "  NAME  meaning" or "  NAME" and deeper lines below.
function plain(text) {
   gsub(/\\/, "\\e", text)
   gsub(/-/, "\\-", text)
   sub(/^['.]/, "\\\\\\&&", text)
   return text
}
function heading(text) {
   print ".SH " toupper(text)
}
NR == 1 {
   sub(/^usage: */, "")
   usage = $0
   next
}
# lines of the usage that go on
usage != "" && !named && /^ / {
   usage = usage " " $0
   next
}
/^ *$/ {
   blank = 1
   next
}
# the first words of the description are the name's
!named {
   named = 1
   first = $0
   sub(/[.:,].*/, "", first)
   print ".TH " toupper(name) " 1"
   heading("name")
   print plain(name) " \\- " tolower(substr(first, 1, 1)) plain(substr(first, 2))
   heading("synopsis")
   print plain(usage)
   heading("description")
}
tolower($0) ~ /^exit status/ {
   heading("exit status")
   sub(/^[^:0-9]*[:0-9]/, "0")
   sub(/^0 *0/, "0")
}
/^[a-z].*:$/ {
   heading(substr($0, 1, length($0) - 1))
   next
}
/^  ? ?[^ ]/ {
   sub(/^ +/, "")
   print ".TP"
   meaning = match($0, /   *[^ ]/) ? substr($0, RSTART + RLENGTH - 1) : ""
   print "\\fB" plain(meaning == "" ? $0 : substr($0, 1, RSTART - 1)) "\\fR"
   if (meaning != "") print plain(meaning)
   blank = 0
   next
}
{
   if (blank && !/^ /) print ".PP"
   blank = 0
   sub(/^ +/, "")
   print plain($0)
}
