//! Simulates and renders what small particles do to light: sky, clouds, smoke, desert sand, shafts of light.
