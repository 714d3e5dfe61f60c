# Installs BUILD under WORK, builds and tests this folder's project against what was installed, and runs the installed
# command. Run with -DBUILD=... -DWORK=... -DCONFIG=... -DGENERATOR=... -DCOMPILER=... -DFLAGS=... -P.
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

if(CONFIG)
  set(config --config ${CONFIG})
  set(test_config -C ${CONFIG})
endif()
set(prefix ${WORK}/prefix)
set(ENV{WRINKLE_CACHE_DIR} ${WORK}/cache)
file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} ${config} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_BUILD_TYPE=${CONFIG}
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${WORK}/build ${config})
run(${CMAKE_CTEST_COMMAND} --test-dir ${WORK}/build ${test_config} --output-on-failure --no-tests=error)
run(${prefix}/bin/wrinkle devices)
