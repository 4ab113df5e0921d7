# Pages of web/, built by npm and held by the library as strings; empty ones without the viewer.
set(web ${PROJECT_SOURCE_DIR}/web)
if(MORSEL_BUILD_VIEWER)
  file(GLOB_RECURSE web_sources CONFIGURE_DEPENDS ${web}/src/*)
  # npm writes this file last.
  add_custom_command(OUTPUT ${web}/node_modules/.package-lock.json
    COMMAND ${NPM_PROGRAM} ci --no-audit --no-fund --loglevel=error
    DEPENDS ${web}/package.json ${web}/package-lock.json
    WORKING_DIRECTORY ${web} COMMENT "Fetching the packages of the viewer (npm ci)" VERBATIM)
  # Two folders use it: only as a target is it run once.
  add_custom_target(web_packages DEPENDS ${web}/node_modules/.package-lock.json)
endif()

# morsel_build_page(NAME PAGE): builds web/NAME.html as the one file PAGE.
function(morsel_build_page name page)
  if(NOT MORSEL_BUILD_VIEWER)
    file(WRITE ${page} "")
    return()
  endif()
  get_filename_component(folder ${page} DIRECTORY)
  add_custom_command(OUTPUT ${page}
    COMMAND ${NPM_PROGRAM} run --silent build -- --mode ${name} --logLevel warn --outDir ${folder}
    DEPENDS web_packages ${web}/package-lock.json ${web}/${name}.html ${web}/vite.config.ts
            ${web}/single_page.ts ${web_sources}
    WORKING_DIRECTORY ${web} COMMENT "Building the page ${name}" VERBATIM)
endfunction()

# morsel_embed_page(PAGE SOURCE HEADER FUNCTION): writes SOURCE, in which FUNCTION of HEADER returns
# the text of PAGE.
function(morsel_embed_page page source header function)
  add_custom_command(OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DPAGE=${page} -DSOURCE=${source} -DHEADER=${header}
            -DFUNCTION=${function} -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${page} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake VERBATIM)
endfunction()
