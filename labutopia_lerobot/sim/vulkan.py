"""Asking Vulkan whether it is there: Filament ends the process where it is not."""

import ctypes
from functools import cache

_LIBRARY = "libvulkan.so.1"
_INSTANCE_CREATE_INFO = 1  # VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO
_NAME = slice(20, 276)
"""Bytes of `deviceName` in `VkPhysicalDeviceProperties`: behind five numbers of 32 bits."""
_ROOM = 4096
"""More bytes than `VkPhysicalDeviceProperties` has (Vulkan 1.3: 824)."""


class _InstanceCreateInfo(ctypes.Structure):
    _fields_ = (
        ("sType", ctypes.c_int),
        ("pNext", ctypes.c_void_p),
        ("flags", ctypes.c_uint32),
        ("pApplicationInfo", ctypes.c_void_p),
        ("enabledLayerCount", ctypes.c_uint32),
        ("ppEnabledLayerNames", ctypes.c_void_p),
        ("enabledExtensionCount", ctypes.c_uint32),
        ("ppEnabledExtensionNames", ctypes.c_void_p),
    )


@cache
def vulkan_device() -> str | None:
    """Return what Vulkan calls its first device, such as `llvmpipe (LLVM 15.0.6, 256 bits)`.

    Returns:
        The name, or None where there is no Vulkan, or no device.
    """
    try:
        vulkan = ctypes.CDLL(_LIBRARY)
    except OSError:
        return None
    instance = ctypes.c_void_p()
    info = _InstanceCreateInfo(sType=_INSTANCE_CREATE_INFO)
    if vulkan.vkCreateInstance(ctypes.byref(info), None, ctypes.byref(instance)) != 0:
        return None
    try:
        count, device = ctypes.c_uint32(1), ctypes.c_void_p()
        vulkan.vkEnumeratePhysicalDevices(instance, ctypes.byref(count), ctypes.byref(device))
        if not count.value or not device:
            return None
        properties = ctypes.create_string_buffer(_ROOM)
        vulkan.vkGetPhysicalDeviceProperties(device, properties)
        return properties.raw[_NAME].partition(b"\0")[0].decode()
    finally:
        vulkan.vkDestroyInstance(instance, None)
