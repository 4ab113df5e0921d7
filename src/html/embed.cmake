# Writes SOURCE, a C++ file that holds the text of PAGE.
file(READ ${PAGE} page)
file(WRITE ${SOURCE} "#include \"html/viewer.hpp\"

std::string_view morsel::viewer_page() noexcept {
  return R\"viewer(${page})viewer\";
}
")
