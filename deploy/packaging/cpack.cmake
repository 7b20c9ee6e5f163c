# SPDX-License-Identifier: Apache-2.0
# What CPack knows of the packages: names, descriptions, dependencies, scripts.
set(CPACK_PACKAGE_NAME ehm)
set(CPACK_PACKAGE_VENDOR "Engine health monitor authors")
set(CPACK_PACKAGE_CONTACT ${EHM_PACKAGE_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL monitor engine_sim tools dev)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(scripts ${CMAKE_CURRENT_BINARY_DIR})
set(sysusers "systemd | systemd-standalone-sysusers")

set(CPACK_DEBIAN_MONITOR_PACKAGE_NAME ehm-monitor)
set(CPACK_COMPONENT_MONITOR_DESCRIPTION "real-time turbofan health monitor
A service that estimates the health parameters of turbofan engines, thrust,
turbine inlet temperature and stall margin from sensor samples on DDS, each
with its standard deviation, and publishes them on DDS.")
set(CPACK_DEBIAN_MONITOR_PACKAGE_DEPENDS ${sysusers})
set(CPACK_DEBIAN_MONITOR_PACKAGE_RECOMMENDS ehm-tools)
set(CPACK_DEBIAN_MONITOR_PACKAGE_CONTROL_EXTRA ${scripts}/ehm-monitor/postinst ${scripts}/ehm-monitor/prerm
    ${scripts}/ehm-monitor/postrm ${scripts}/ehm-monitor/conffiles)

set(CPACK_DEBIAN_ENGINE_SIM_PACKAGE_NAME ehm-engine-sim)
set(CPACK_COMPONENT_ENGINE_SIM_DESCRIPTION "turbofan simulator that publishes sensor samples
A service that flies a nonlinear two-spool turbofan with its control, wear and
sensors, and publishes the sensors' samples on DDS as an engine would.")
set(CPACK_DEBIAN_ENGINE_SIM_PACKAGE_DEPENDS ${sysusers})
set(CPACK_DEBIAN_ENGINE_SIM_PACKAGE_SUGGESTS "ehm-monitor, gnuplot-nox")
set(CPACK_DEBIAN_ENGINE_SIM_PACKAGE_CONTROL_EXTRA ${scripts}/ehm-engine-sim/postinst
    ${scripts}/ehm-engine-sim/prerm ${scripts}/ehm-engine-sim/postrm ${scripts}/ehm-engine-sim/conffiles)

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME ehm-tools)
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "bench and display of the engine health monitor
Makes the design file that the monitor loads from an engine's linear model
(tuner_design), shows truth beside estimate while the pair runs (ehm_watch),
and gives orders to both (ehm_command).")
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS openssl)

set(CPACK_DEBIAN_DEV_PACKAGE_NAME ehm-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEV_DESCRIPTION "IDL and CMake package of the engine health monitor's topics
For people who write DDS nodes that publish samples to the monitor or read its
estimates: the IDL, the types generated for Fast DDS with readers and writers,
and a CMake package.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libfastrtps-dev, libfastcdr-dev")

include(CPack)
