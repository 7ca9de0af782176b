#!/usr/bin/awk -f
# mistakes.awk list OUTPUT TABLE...      writes a line for each mistake: its solution, name, table,
#                                        exercise, diagnosis and "alone", separated by tabs
# mistakes.awk put OUTPUT TABLE NAME     writes the solution with one mistake
# mistakes.awk put_all FOLDER TABLE...   writes the solutions with each mistake: FOLDER/NAME/FILE
#
# Reads tables of typical mistakes, tests/NN_name/mistakes/*.txt, and of correct variants of the
# solution, tests/NN_name/variants.txt. "-" as OUTPUT is standard output; a file that already has the
# right text is not touched, so that nothing is rebuilt. A table:
#
#   = solutions/02_pi/pi.cpp
#
#   == Lab 2.1 pi_from_float: float-counter, alone
#   The hits are counted in a float, and no diagnosis may be given beside this one.
#   -  std::int64_t hits = 0;
#   +  float hits = 0;
#
#    double pi(std::int64_t n) {
#   +  n = std::max(n, 1);
#
# "-" marks an old line, "+" a new one, a space one that stays. The old lines of a place, with those
# that stay, must occur exactly once in the solution; an empty line begins the next place, which is
# further down. A variant has only a name: "== pi_by_sectors". "#" begins a comment.

BEGIN {
  ORS = ""
  mode = ARGV[1]
  if (mode !~ /^(list|put|put_all)$/ || ARGC < 4 || (mode == "put" && ARGC != 5)) {
    print "usage: mistakes.awk list|put|put_all OUTPUT TABLE... [NAME]; its head says more\n" >"/dev/stderr"
    exit 2
  }
  for (i = 3; i < (mode == "put" ? 4 : ARGC); ++i) read_table(ARGV[i])
  if (mode == "list") list(ARGV[2])
  if (mode == "put") put(ARGV[2], ARGV[3], ARGV[4])
  if (mode == "put_all") put_all(ARGV[2])
  exit failed
}

function fail(file, line, words) {
  print file ":" line ": error: " words "\n" >"/dev/stderr"
  failed = 1
}

# Reports an error about a mistake, or about one place of it.
function refuse(i, place, words) {
  fail(table[i], place ? row_of[i, place] : head[i], name[i] ": " words)
}

# Reading -----------------------------------------------------------------------------------------

function read_table(file,    line, status) {
  if (!match(file, /tests\/[^\/]*\/(mistakes\/[^\/]*|variants)\.txt$/)) {
    fail(file, 0, "a table is tests/NN_name/mistakes/*.txt or tests/NN_name/variants.txt")
    return
  }
  root = substr(file, 1, RSTART - 1)
  solution = ""
  is_variant = file ~ /\/variants\.txt$/
  this_table = file
  row = in_mistake = in_place = 0
  while ((status = (getline line <file)) > 0) {
    ++row
    read_line(line, substr(line, 1, 1))
  }
  if (status < 0) fail(file, 0, "it cannot be read")
  close(file)
  end_mistake()
}

function read_line(line, first) {
  if (line == "") in_place = 0
  else if (first == "#") return
  else if (line ~ /^= /) begin_solution(substr(line, 3))
  else if (line ~ /^==/) begin_mistake(line)
  else if (!in_mistake) fail(this_table, row, "this belongs to no mistake: " line)
  else if (first ~ /[-+ ]/) add_line(first, substr(line, 2) "\n")
  else if (places[count] > 0) fail(this_table, row, "a line of a change begins with -, + or a space: " line)
  else sentence[count] = line
}

function begin_solution(file) {
  end_mistake()
  solution = file
  if (file !~ /^solutions\/[^\/]+\/.+/) fail(this_table, row, "expected \"= solutions/NN_name/FILE\": " file)
}

function begin_mistake(line,    expected, words) {
  end_mistake()
  expected = is_variant ? "== name" : "== Lab N.K name: diagnosis[, alone]"
  if (is_variant ? line !~ /^== [a-z0-9_]+$/ \
                 : line !~ /^== Lab [0-9]+\.[0-9]+ [a-z0-9_]+: [a-z0-9-]+(, alone)?$/) {
    fail(this_table, row, "expected \"" expected "\": " line)
    return
  }
  if (solution == "") fail(this_table, row, "a line \"= solutions/NN_name/FILE\" must come first")
  in_mistake = 1
  ++count
  split(line, words, /[:,]? /)
  name[count] = words[is_variant ? 2 : 4]
  exercise[count] = words[3]
  diagnosis[count] = words[5]
  alone[count] = words[6]
  origin[count] = root solution
  file_of[count] = solution
  table[count] = this_table
  head[count] = row
  take_name(count, this_table)
}

# A name may be used once per lab.
function take_name(i, lab) {
  sub(/\/mistakes\/[^\/]*$/, "", lab)
  if ((lab, name[i]) in owner) refuse(i, 0, "the name is taken, " owner[lab, name[i]])
  owner[lab, name[i]] = table[i] ":" head[i]
}

function add_line(mark, text,    place) {
  if (!in_place) {
    in_place = 1
    row_of[count, ++places[count]] = row
  }
  place = places[count]
  if (mark != "+") old[count, place] = old[count, place] text
  if (mark != "-") changed[count, place] = changed[count, place] text
}

function end_mistake(    place) {
  in_place = 0
  if (!in_mistake) return
  in_mistake = 0
  if (sentence[count] !~ /\.$/) refuse(count, 0, "expected a sentence below the name")
  if (places[count] == 0) refuse(count, 0, "nothing is changed")
  for (place = 1; place <= places[count]; ++place) {
    if (old[count, place] == "")
      refuse(count, place, "what is added needs a line beside it that stays")
    else if (old[count, place] == changed[count, place])
      refuse(count, place, "nothing is changed here")
  }
}

# Changing ----------------------------------------------------------------------------------------

# Returns the text of a file, each line with the newline before it; "" if there is no such file.
function text_of(file,    line, text) {
  while ((getline line <file) > 0) text = text "\n" line
  close(file)
  return text
}

function line_at(text, position) {
  text = substr(text, 1, position)
  return gsub(/\n/, "\n", text)
}

# Returns where the old lines of a place begin in the text, at the newline before them; 0 if they do
# not occur exactly once.
function find_place(i, place, text,    lines, first, second, trouble) {
  lines = "\n" old[i, place]
  first = index(text, lines)
  second = first ? index(substr(text, first + 1), lines) : 0
  if (first && !second) return first
  trouble = "do not occur"
  if (second) trouble = "occur in lines " line_at(text, first) " and " line_at(text, first + second)
  lines = substr(lines, 1, length(lines) - 1)
  refuse(i, place, "these lines must occur exactly once in " file_of[i] ", but " trouble ":" lines)
  return 0
}

# Returns the solution with a mistake; "" if the mistake does not fit it.
function mistaken(i,    text, result, done, place, found) {
  if (!(origin[i] in texts)) texts[origin[i]] = text_of(origin[i]) "\n"
  text = texts[origin[i]]
  if (text == "\n") {
    refuse(i, 0, "there is no " file_of[i])
    return ""
  }
  done = 1
  for (place = 1; place <= places[i]; ++place) {
    if (!(found = find_place(i, place, text))) return ""
    if (found < done - 1) {
      refuse(i, place, "this place is not below the one before it")
      return ""
    }
    result = result substr(text, done, found - done + 1) changed[i, place]
    done = found + length(old[i, place]) + 1
  }
  return substr(result substr(text, done), 2)
}

# Writing -----------------------------------------------------------------------------------------

function write(file, text) {
  if (file == "-") print text
  else if (substr(text_of(file) "\n", 2) != text) {
    print text >file
    close(file)
  }
}

function list(file,    i, text) {
  for (i = 1; i <= count; ++i) {
    text = text file_of[i] "\t" name[i] "\t" table[i]
    if (exercise[i] != "") text = text "\t" exercise[i] "\t" diagnosis[i]
    text = text (alone[i] != "" ? "\talone" : "") "\n"
  }
  if (!failed) write(file, text)
}

function put(file, from, wanted,    i, text) {
  for (i = 1; i <= count && name[i] != wanted; ++i) continue
  if (i > count) fail(from, 0, "there is no mistake \"" wanted "\"")
  else if ((text = mistaken(i)) != "") write(file, text)
}

function put_all(folder,    i, file, text, folders) {
  for (i = 1; i <= count; ++i) {
    file = file_of[i]
    sub(/^solutions\/[^\/]*\//, "", file)
    target[i] = file = folder "/" name[i] "/" file
    sub(/\/[^\/]*$/, "", file)
    gsub(/'/, "'\\''", file)
    folders = folders " '" file "'"
  }
  if (folders != "" && system("mkdir -p" folders) != 0) exit 1
  for (i = 1; i <= count; ++i)
    if ((text = mistaken(i)) != "") write(target[i], text)
}
