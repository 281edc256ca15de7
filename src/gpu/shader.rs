//! Shaders, joined from plain `.wgsl` files, with a map from their lines to files.

/// One `.wgsl` file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Module {
    name: &'static str,
    text: &'static str,
}

macro_rules! modules {
    ($($(#[$doc:meta])* $constant:ident = $file:literal;)*) => {
        impl Module {
            $($(#[$doc])* pub(crate) const $constant: Self =
                Self { name: $file, text: include_str!(concat!("shaders/", $file)) };)*

            /// Every module, each after those that it uses.
            #[cfg(test)]
            pub(crate) const ALL: &[Self] = &[$(Self::$constant),*];
        }
    };
}

modules! {
    /// Types and functions of all light shaders.
    COMMON = "common.wgsl";
    /// Point and directional lights.
    POINT = "point.wgsl";
    /// Point lights with measured intensities.
    WEB = "web.wgsl";
    /// Many point lights that stand for one light.
    CLUSTER = "cluster.wgsl";
    /// Punctual lights that are fitted to a light.
    FIT = "fit.wgsl";
    /// Linear lights.
    LINE = "line.wgsl";
    /// Arcs of a polygon above a horizon.
    CONTOUR = "contour.wgsl";
    /// Polygonal lights.
    POLYGON = "polygon.wgsl";
    /// Flat lights as one point light a component.
    ONE_SHOT = "one_shot.wgsl";
    /// Spherical lights.
    SPHERE = "sphere.wgsl";
    /// Textured lights.
    TEXTURED = "textured.wgsl";
    /// Caps infinitely far away.
    CAP = "cap.wgsl";
    /// Skies.
    SKY = "sky.wgsl";
    /// Disks, diffuse.
    DISK = "disk.wgsl";
    /// Disks, specular.
    DISK_PHONG = "disk_phong.wgsl";
    /// The pass's triangle.
    FULLSCREEN = "fullscreen.wgsl";
    /// What rays meet.
    PRIMITIVES = "primitives.wgsl";
    /// The first layer.
    GBUFFER = "gbuffer.wgsl";
    /// Whether something stands between.
    OCCLUSION = "occlusion.wgsl";
    /// What is hidden of a linear light.
    LINE_HIDDEN = "line_hidden.wgsl";
    /// Numbers that cover a square evenly.
    SEQUENCE = "sequence.wgsl";
    /// What shadows are cast on.
    SHADOWED = "shadowed.wgsl";
    /// Points of lights.
    SHADOW_LIGHTS = "shadow_lights.wgsl";
    /// A light's shadow, by rays.
    SHADOW = "shadow.wgsl";
    /// A linear light's shadow.
    LINE_SHADOW = "line_shadow.wgsl";
    /// A light's layer.
    LAYER = "layer.wgsl";
    /// A function over a table.
    TWIN = "twin.wgsl";
    /// The sum of the layers.
    COMPOSITE = "composite.wgsl";
    /// The tone curve.
    TONE = "tone.wgsl";
    /// The picture.
    DISPLAY = "display.wgsl";
    /// Some of the picture's numbers.
    SURVEY = "survey.wgsl";
}

impl Module {
    /// Those of lights, each after those that it uses.
    pub(crate) const LIGHTS: &[Self] = &[
        Self::COMMON,
        Self::POINT,
        Self::WEB,
        Self::FIT,
        Self::CLUSTER,
        Self::LINE,
        Self::CONTOUR,
        Self::POLYGON,
        Self::ONE_SHOT,
        Self::SPHERE,
        Self::TEXTURED,
        Self::CAP,
        Self::SKY,
        Self::DISK,
        Self::DISK_PHONG,
    ];

    #[cfg(test)]
    pub(crate) fn name(&self) -> &'static str {
        self.name
    }

    pub(crate) fn text(&self) -> &'static str {
        self.text
    }
}

/// Modules joined in order, and text that was made for the occasion.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    text: String,
    /// Name and first line, from 1, of each part.
    parts: Vec<(&'static str, usize)>,
}

impl Source {
    /// The modules in order, each after those that it uses.
    pub(crate) fn join(modules: &[Module]) -> Self {
        let mut source = Self { text: String::new(), parts: Vec::new() };
        for module in modules {
            source.push(module.name, module.text);
        }
        source
    }

    /// Adds text that belongs to no file; `name` stands for one in errors.
    pub(crate) fn with(mut self, name: &'static str, text: &str) -> Self {
        self.push(name, text);
        self
    }

    fn push(&mut self, name: &'static str, text: &str) {
        self.parts.push((name, self.text.lines().count() + 1));
        self.text.push_str(text);
        if !self.text.ends_with('\n') {
            self.text.push('\n');
        }
    }

    /// The same with every occurrence of `from` replaced, and how many there were.
    pub(crate) fn replaced(&self, from: &str, to: &str) -> (Self, usize) {
        let count = self.text.matches(from).count();
        (Self { text: self.text.replace(from, to), parts: self.parts.clone() }, count)
    }

    /// The whole text.
    #[cfg(test)]
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// File and line, both for people, of a line of the whole text, from 1.
    pub(crate) fn place(&self, line: usize) -> (&'static str, usize) {
        let part = self.parts.iter().rev().find(|(_, first)| *first <= line);
        part.map_or(("shader", line), |(name, first)| (name, line - first + 1))
    }
}

#[cfg(feature = "gpu")]
impl Source {
    /// The shader module.
    ///
    /// # Panics
    ///
    /// With file, line and message where the text is not WGSL: the texts are our own.
    pub(crate) fn compile(&self, device: &wgpu::Device, label: &str) -> wgpu::ShaderModule {
        let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(self.text.as_str().into()),
        });
        if let Some(error) = pollster::block_on(scope.pop()) {
            let info = pollster::block_on(module.get_compilation_info());
            panic!("{}", self.describe(&info, &error));
        }
        module
    }

    fn describe(&self, info: &wgpu::CompilationInfo, error: &wgpu::Error) -> String {
        use std::fmt::Write as _;
        let mut text = String::new();
        for message in &info.messages {
            if let Some(location) = message.location {
                let (file, line) = self.place(location.line_number as usize);
                let _ = writeln!(text, "{file}:{line}:{}: {}", location.line_position, message.message);
            }
        }
        if text.is_empty() { error.to_string() } else { text }
    }
}
