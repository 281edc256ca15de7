//! The WGSL against naga: it parses, it is valid, and its structures are laid out as ours.

use std::collections::HashMap;

use super::composite::CompositePass;
use super::display::DisplayPass;
use super::gbuffer::GBufferPass;
use super::lights::Responder;
use super::shader::{Module, Source};
use super::shadows::Finder;
use super::survey::SurveyPass;
use super::twin;
use super::types::LAYOUTS;

/// The module that naga makes of a source; an error says file and line.
#[track_caller]
fn check(source: &Source) -> naga::Module {
    let module = naga::front::wgsl::parse_str(source.text()).unwrap_or_else(|error| {
        let line = error.location(source.text()).map_or(0, |location| location.line_number as usize);
        let (file, line) = source.place(line);
        panic!("{file}:{line}: {}", error.emit_to_string(source.text()));
    });
    let flags = naga::valid::ValidationFlags::all();
    let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::default());
    if let Err(error) = validator.validate(&module) {
        let line = error.location(source.text()).map_or(0, |location| location.line_number as usize);
        let (file, line) = source.place(line);
        panic!("{file}:{line}: {}", error.emit_to_string(source.text()));
    }
    module
}

fn every_source() -> Vec<Source> {
    let mut sources: Vec<_> =
        Responder::ALL.iter().flat_map(|responder| [true, false].map(|matte| responder.source(matte))).collect();
    sources.extend(Finder::ALL.iter().map(Finder::source));
    sources.push(GBufferPass::source());
    sources.extend(CompositePass::sources());
    sources.extend([DisplayPass::source(), SurveyPass::source()]);
    sources.extend(twin::FUNCTIONS.iter().map(twin::source));
    sources
}

#[test]
fn every_shader_is_valid() {
    for source in every_source() {
        check(&source);
    }
}

#[test]
fn every_module_is_in_a_shader() {
    let sources = every_source();
    for module in Module::ALL {
        let used = sources.iter().any(|source| source.text().contains(module.text()));
        assert!(used, "{} is in no shader", module.name());
    }
}

#[test]
fn every_module_of_a_light_is_among_those_of_lights() {
    for responder in Responder::ALL {
        let missing: Vec<_> = responder.modules.iter().filter(|module| !Module::LIGHTS.contains(module)).collect();
        assert!(missing.is_empty(), "{}: {missing:?}", responder.function);
    }
}

#[test]
fn structures_are_laid_out_as_in_wgsl() {
    let mut found = HashMap::new();
    for source in every_source() {
        for (_, ty) in check(&source).types.iter() {
            if let (Some(name), naga::TypeInner::Struct { members, span }) = (&ty.name, &ty.inner) {
                let fields: Vec<_> =
                    members.iter().map(|m| (m.name.clone().unwrap_or_default(), m.offset as usize)).collect();
                found.insert(name.clone(), (fields, *span as usize));
            }
        }
    }
    for (name, size, fields) in LAYOUTS {
        let (wgsl_fields, wgsl_size) = &found[*name];
        let fields: Vec<_> = fields
            .iter()
            .filter(|(field, _)| !field.starts_with("pad"))
            .map(|(field, offset)| ((*field).to_owned(), *offset))
            .collect();
        assert_eq!(&fields, wgsl_fields, "fields of {name}");
        assert_eq!(size, wgsl_size, "size of {name}");
    }
}

#[test]
fn an_error_in_a_shader_names_file_and_line() {
    let source = Source::join(&[Module::COMMON]).with("broken.wgsl", "fn f() {}\nfn g() { nonsense }\n");
    let error = naga::front::wgsl::parse_str(source.text()).expect_err("nonsense is no WGSL");
    let line = error.location(source.text()).expect("the error has a place").line_number as usize;
    assert_eq!(source.place(line), ("broken.wgsl", 2), "{error}");
    assert_eq!(source.place(1), ("common.wgsl", 1), "the first line is the first file's");
}
