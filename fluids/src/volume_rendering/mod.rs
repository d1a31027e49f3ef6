//! The picture of smoke inside a closed surface, with solid objects and self-shadowing.
//!
//! # What it computes
//! [`render`] takes a [`Scene`] (the surface of the smoke with the ages of its vertices, solids, camera,
//! light, medium) and [`RenderParameters`], and gives a [`Picture`]: planes of numbers, not a file. The smoke
//! is of one density inside. For the ray of each pixel:
//! ```text
//!   alpha     what the smoke hides:  1 - exp(-extinction thickness)
//!   scatter   light scattered once toward the eye, shadowed by smoke and solids; from 0 to alpha
//!   age       mean time since emission along the ray's way through the smoke
//!   backdrop  what is behind the smoke: solids by Lambert's law with their shadows, the background
//!   composite albedo (radiance scatter + ambient alpha) + (1 - alpha) backdrop, after a blur by age if asked for
//! ```
//! [`render_particles`] gives the same planes of smoke that is given by marker particles.
//! [`voxel_volumes()`] gives what the shadow texture is made of: the volume of smoke in each cube of a lattice.
//!
//! # What it promises
//! * A ray crosses a closed surface into the inside as often as out of it, in every position of both, if the
//!   eye is outside: coverage is decided in integers. So no pixel shows a gap or a streak.
//! * Any surface without boundary has a picture: where it intersects itself or is inside out, an
//!   [`InteriorRule`] tells from winding numbers what is smoke.
//! * Alpha and age have the accuracy of the crossings' depths: vertices are placed to 2^-16 pixels. Every
//!   channel is within 1 % of its maximum of a twin that traces all rays exactly, in all scenes of
//!   `tests/fluids/volume_rendering`, sheets of a quarter of a voxel among them: where the shadow texture is
//!   rough, light is traced through the surface, in closed form along the ray. Shadows of solids have exact
//!   edges.
//! * The same bits for any number of threads, and, with all lengths times a power of two and the extinction
//!   divided by it, the same bits too.
//! * No scene makes it panic; what makes no sense is a typed error. Memory besides the image and the shadow
//!   texture is bounded by the triangles and a constant for each thread.
//!
//! # What it does not promise
//! * Light scattered more than once, density that varies inside, point lights.
//! * That bound where columns of the shadow texture hold more triangles than
//!   [`RenderParameters::traced_triangles`]: there, light is that of the texture alone, which is off by several
//!   percent for sheets as thin as two voxels and where the optical depth of a voxel is not small.
//! * Smooth edges of solids: a pixel is one ray. Smoke has soft edges by itself, as its thickness goes to
//!   zero there.
//! * A blur that knows depth (see [`AgeBlur`]).
//!
//! # Method
//! \[Brochu12, section 6.6\], each stage a file:
//! ```text
//! camera, project, clip    triangles in the image, clipped in front of the eye      [Sutherland74, Blinn77]
//! raster, crossings        depths at which each ray crosses the surface: A-buffer   [Pineda88, Carpenter84]
//! resolve                  entering and leaving counted: stretches of smoke
//! light_space, voxels      volume of smoke in each voxel, by clipping the surface
//! shadow                   length of smoke along the light, and where it is rough
//! prisms, columns          triangles as seen from the light, found by place
//! light_paths              light traced through the surface
//! occluders, cover         shadows of solids
//! scattering               transmittance and single scattering along the stretches  [Max95]
//! solids                   solid objects: visibility, shade, shadow
//! blur, composite          softening by age; everything in one picture              [Porter84]
//! ```
//!
//! # Complexity
//! Linear in the triangles, the crossings of all rays, the samples along them, and the voxels of the texture;
//! samples where light is traced, or solids cast shadows, cost as much as there are triangles in a column.

mod blur;
mod camera;
mod clip;
mod columns;
mod composite;
mod cover;
mod crossings;
mod error;
mod exponential;
mod image;
mod light_paths;
mod light_space;
mod occluders;
mod parameters;
mod particles;
mod picture;
mod pixels;
mod prisms;
mod project;
mod raster;
mod resolve;
mod scattering;
mod scene;
mod shadow;
mod solids;
mod voxel_volumes;
mod voxels;

pub use camera::Camera;
pub use error::RenderError;
pub use image::Image;
pub use parameters::{AgeBlur, RenderParameters};
pub use particles::{ParticleReport, ParticleScene, render_particles};
pub use picture::{Picture, RenderReport, RenderSeconds, render};
pub use scene::{InteriorRule, Light, Medium, Scene, Solid};
pub use voxel_volumes::{VoxelVolumes, voxel_volumes};

/// Most pixels along a side of an image: coordinates of the rasteriser stay below 2^30.
pub const MAX_SIDE: u32 = 1 << 14;

/// Most pixels of an image: 67 million, whose planes take 2.4 GB, and 2.7 GB more while they are blurred.
pub const MAX_PIXELS: u64 = 1 << 26;

/// Most voxels of a shadow texture: 268 million, which take 3.3 GB while it is made and 1.1 GB then.
pub const MAX_VOXELS: u64 = 1 << 28;
