# README.md shows docs/example.cpp to the letter.
file(READ ${ROOT}/README.md readme)
file(READ ${ROOT}/docs/example.cpp example)
string(FIND "${readme}" "${example}" at)
if(at EQUAL -1)
  message(FATAL_ERROR "README.md does not show docs/example.cpp as it is")
endif()
