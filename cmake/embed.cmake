# Writes SOURCE, a C++ file in which FUNCTION, declared in HEADER, returns the text of PAGE.
file(READ ${PAGE} page)
file(WRITE ${SOURCE} "#include \"${HEADER}\"

std::string_view ${FUNCTION}() noexcept {
  return R\"viewer(${page})viewer\";
}
")
